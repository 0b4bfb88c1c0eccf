#pragma once

#include <array>
#include <compare>
#include <map>
#include <memory>
#include <shared_mutex>

#include "render/block.h"

namespace tenon {

/// What single scattering by microfacets returns.
enum class ScatteredPart {
  reflected_by_perfect_mirrors,  ///< conductors whose every microfacet reflects all light
  reflected_by_dielectric,
  all_of_dielectric,  ///< reflected and refracted
};

/// The share of the light from one side that a rough surface scatters once and does not lose between its microfacets,
/// as a function of the angle: its directional albedo. What is missing from 1 would have been scattered more often.
class AlbedoTable {
 public:
  /// @param alpha  GGX's width
  /// @param eta    index of refraction before the surface over that behind it; not used for conductors
  AlbedoTable(ScatteredPart part, double alpha, double eta);

  /// @param cos   of the angles to the normal, 0..1
  /// @param size  of the block, in whole vectors
  void find(const NumberBlock& cos, std::size_t size, NumberBlock& albedo) const;

  // Nodes at cos = (i / intervals)^2: the albedo falls steeply where light grazes the surface.
  static constexpr int intervals = 64;
  /// The node before the first, all, and one behind the last: beyond its ends the curve goes straight on.
  using Nodes = std::array<double, intervals + 3>;

 private:
  Nodes nodes_;
};

/// Tables, each made when it is first asked for. Which they are does not depend on who asks first.
class AlbedoTables {
 public:
  /// Those of all pictures that this process takes: a table takes as long as some ten thousand rays.
  static AlbedoTables& shared();

  const AlbedoTable& get(ScatteredPart part, double alpha, double eta = 1);

 private:
  struct Key {
    ScatteredPart part;
    double alpha, eta;
    auto operator<=>(const Key&) const = default;
  };
  std::shared_mutex mutex_;
  std::map<Key, std::unique_ptr<AlbedoTable>> tables_;
};

}  // namespace tenon
