#include "accel/leaf_slabs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "primitive/dispatch.h"

namespace tenon {

namespace {

constexpr double half_root = 0.70710678118654752440;   // 1/sqrt(2)
constexpr double third_root = 0.57735026918962576451;  // 1/sqrt(3)

constexpr std::array<Vec3, most_slab_normals> all_normals{{
    {1, 0, 0},
    {0, 1, 0},
    {0, 0, 1},
    {third_root, third_root, third_root},
    {third_root, third_root, -third_root},
    {third_root, -third_root, third_root},
    {third_root, -third_root, -third_root},
    {half_root, half_root, 0},
    {half_root, -half_root, 0},
    {half_root, 0, half_root},
    {half_root, 0, -half_root},
    {0, half_root, half_root},
    {0, half_root, -half_root},
}};

// The slab of a box: the corner that lies farthest along the normal, and its opposite.
Slab slab_of(const Box3& box, const Vec3& n) {
  Slab slab;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = n[axis] * box.lower[axis], b = n[axis] * box.upper[axis];
    slab.low += std::min(a, b);
    slab.high += std::max(a, b);
  }
  return slab;
}

}  // namespace

std::span<const Vec3> slab_normals(std::size_t count) {
  return std::span<const Vec3>(all_normals).first(count);
}

LeafSlabs::LeafSlabs(const CsgTree& tree, const std::vector<EnclosedLeaf>& leaves, std::size_t normals)
    : normals_(normals) {
  const double margin = enclosure_margin(tree);
  slabs_.reserve(leaves.size() * normals);
  for (const EnclosedLeaf& l : leaves) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int axis = static_cast<int>(i);
      slabs_.push_back({l.box.lower[axis], l.box.upper[axis]});
    }
    for (const Vec3& n : slab_normals(normals).subspan(3)) {
      const Leaf& leaf = tree[l.leaf];
      const Slab cut = slab_of(l.box, n);
      slabs_.push_back(
          {std::max(cut.low, -world_support(tree.primitives, leaf.primitive, leaf.placement, -n) - margin),
           std::min(cut.high, world_support(tree.primitives, leaf.primitive, leaf.placement, n) + margin)});
    }
  }
}

}  // namespace tenon
