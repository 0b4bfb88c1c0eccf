#include "accel/cells/leaf_regions.h"

#include <cmath>

#include "accel/enclosures.h"
#include "primitive/dispatch.h"
#include "primitive/lists.h"

namespace tenon::cells {

namespace {

double square(double x) {
  return x * x;
}

// The scale of a map that only turns and scales alike, up to the given relative error; 0 for any other.
double similarity_scale(const Affine3& map, double error) {
  const double a = dot(map.row(0), map.row(0));
  const double off = std::max({std::fabs(dot(map.row(1), map.row(1)) - a), std::fabs(dot(map.row(2), map.row(2)) - a),
                               std::fabs(dot(map.row(0), map.row(1))), std::fabs(dot(map.row(1), map.row(2))),
                               std::fabs(dot(map.row(2), map.row(0)))});
  return off <= error * a ? std::sqrt(a) : 0;
}

bool maps_axes_to_axes(const Affine3& map) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 row = map.row(i);
    if ((row.x != 0) + (row.y != 0) + (row.z != 0) != 1) return false;
  }
  return true;
}

}  // namespace

LeafRegions::LeafRegions(const CsgTree& tree) : tree_(tree), simple_(tree.leaves.size()) {
  // Covers the leaf's errors of place (enclosure_margin), and the roundings here.
  const double margin = enclosure_margin(tree);
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const Leaf& leaf = tree.leaves[i];
    Simple& simple = simple_[i];
    const Affine3& map = leaf.placement.world_from_local();
    visit(tree.primitives.lists(), leaf.primitive, [&]<class P>(const P& primitive) {
      if constexpr (std::is_same_v<P, Sphere>) {
        // No radius is larger than twice the largest coordinate, so this is another 2^-38 of it.
        const double scale = similarity_scale(map, 0x1p-40);
        if (scale == 0) return;
        simple = {
            Kind::ball, map.translation(), scale * primitive.r - 2 * margin, scale * primitive.r + 2 * margin, {}};
      } else if constexpr (std::is_same_v<P, Box>) {
        if (maps_axes_to_axes(map)) simple = {Kind::upright_box, {}, 0, 0, grown(leaf.bounds, -2 * margin)};
      }
    });
  }
}

Region LeafRegions::classify(LeafId id, const Box3& box) const {
  const Leaf& leaf = tree_[id];
  if (!leaf.bounds.overlaps(box)) return Region::outside;
  const Simple& simple = simple_[id.get()];
  switch (simple.kind) {
    case Kind::ball: {
      double nearest = 0, farthest = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double low = box.lower[axis] - simple.center[axis], high = box.upper[axis] - simple.center[axis];
        if (low > 0) nearest += square(low);
        if (high < 0) nearest += square(high);
        farthest += square(std::max(-low, high));
      }
      if (nearest > square(simple.outer)) return Region::outside;
      return simple.inner > 0 && farthest < square(simple.inner) ? Region::inside : Region::straddles;
    }
    case Kind::upright_box:
      return simple.core.contains(box) ? Region::inside : Region::straddles;
    case Kind::general:
      break;
  }
  return tenon::classify(tree_.primitives, leaf.primitive, leaf.placement.to_local(box));
}

}  // namespace tenon::cells
