#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "accel/midpoint_subdivision.h"
#include "tenon/base/error.h"

namespace tenon {

/// The 3D grid SI of box numbers (RR-612 §3.4): one element per smallest box.
class SpatialIndex {
 public:
  using Number = std::uint32_t;

  SpatialIndex() = default;
  explicit SpatialIndex(const Levels& levels);

  /// What an index of these levels needs.
  static std::size_t memory_bytes(const Levels& levels) {
    return sizeof(Number) << (levels[0] + levels[1] + levels[2]);
  }
  std::size_t memory_bytes() const { return elements_.capacity() * sizeof(Number); }

  const Levels& levels() const { return levels_; }

  /// Writes a box's number to every element that it covers.
  void fill(const CellRange& cells, Number number);

  Number at(const CellIndex& cell) const { return elements_[place(cell)]; }

 private:
  std::size_t place(const CellIndex& c) const {
    return ((std::size_t{c[2]} << levels_[1] | c[1]) << levels_[0]) | c[0];
  }

  Levels levels_{};
  std::vector<Number> elements_;
};

/// The most that the indices of one structure may take, together: levels 8, 8, 8.
inline constexpr std::size_t largest_index_bytes = std::size_t{1} << 26;

/// An error that says what the index needs, when that is more than it may take.
/// @param advice  what to do instead
Status check_index_bytes(const std::string& structure, std::size_t needed, const std::string& advice);

}  // namespace tenon
