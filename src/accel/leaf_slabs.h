#pragma once

#include <span>
#include <vector>

#include "csg/enclosures.h"

namespace tenon {

/// The space between two parallel planes of a known normal n: low <= n·p <= high.
struct Slab {
  double low = 0;
  double high = 0;
};

/// The axes, the diagonals of the unit cube, and those of its faces; each of length 1. The first k make a good choice
/// of k, 3 <= k <= 13.
std::span<const Vec3> slab_normals(std::size_t count);
inline constexpr int most_slab_normals = 13;

/// For each leaf, the slab it fills for each of some normals: together a polyhedron around the part of the leaf that
/// can matter (course, "Polyhedron: intersection of slabs").
class LeafSlabs {
 public:
  /// Each slab is the leaf's own, which its support function gives, cut by that of its enclosure.
  /// @param normals  of slab_normals(); the first three are the axes
  LeafSlabs(const CsgTree& tree, const std::vector<EnclosedLeaf>& leaves, std::size_t normals);

  std::size_t normals() const { return normals_; }
  const Slab& at(std::size_t leaf, std::size_t normal) const { return slabs_[leaf * normals_ + normal]; }

 private:
  std::size_t normals_;
  std::vector<Slab> slabs_;
};

}  // namespace tenon
