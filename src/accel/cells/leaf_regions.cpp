#include "accel/cells/leaf_regions.h"

#include <cmath>

#include "accel/cells/cell_cost.h"
#include "csg/enclosures.h"
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

// Of the distance along one axis from a place to the nearest and the farthest point of an interval.
double nearest_square(double at, double low, double high) {
  return square(std::max({low - at, at - high, 0.0}));
}
double farthest_square(double at, double low, double high) {
  return square(std::max(at - low, high - at));
}

bool maps_axes_to_axes(const Affine3& map) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 row = map.row(i);
    if ((row.x != 0) + (row.y != 0) + (row.z != 0) != 1) return false;
  }
  return true;
}

}  // namespace

LeafRegions::LeafRegions(const CsgTree& tree, const LeafRecords* records)
    : tree_(tree), margin_(2 * enclosure_margin(tree)), leaves_(tree.leaves.size()) {
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const Leaf& leaf = tree.leaves[i];
    RegionLeaf& region = leaves_[i];
    region.leaf = LeafId{i};
    region.bounds = leaf.bounds;
    if (records != nullptr) {
      const double price = CellCost::of_leaf(records->of_leaf[i].kind(), cost(tree.primitives, leaf.primitive));
      region.price = static_cast<float>(price);
    }
    const Affine3& map = leaf.placement.world_from_local();
    visit(tree.primitives.lists(), leaf.primitive, [&]<class P>(const P& primitive) {
      if constexpr (std::is_same_v<P, Sphere>) {
        // No radius is larger than twice the largest coordinate, so this is another 2^-38 of it.
        const double scale = similarity_scale(map, 0x1p-40);
        if (scale == 0) return;
        region.kind = RegionLeaf::Kind::ball;
        region.center = map.translation();
        region.inner_square = square(std::max(scale * primitive.r - margin_, 0.0));
        region.outer_square = square(scale * primitive.r + margin_);
      } else if constexpr (std::is_same_v<P, Box>) {
        if (maps_axes_to_axes(map)) region.kind = RegionLeaf::Kind::upright_box;
      }
    });
  }
}

Region LeafRegions::classify(const RegionLeaf& leaf, const Box3& box) const {
  if (!leaf.bounds.overlaps(box)) return Region::outside;
  switch (leaf.kind) {
    case RegionLeaf::Kind::ball:
    case RegionLeaf::Kind::upright_box:
      return BoxRegions(*this, leaf, box).classify(0, box.lower.x, box.upper.x);
    case RegionLeaf::Kind::general:
      break;
  }
  const Leaf& placed = tree_[leaf.leaf];
  return tenon::classify(tree_.primitives, placed.primitive, placed.placement.to_local(box));
}

BoxRegions::BoxRegions(const LeafRegions& regions, const RegionLeaf& leaf, const Box3& box)
    : regions_(&regions), leaf_(&leaf), box_(&box) {
  std::array<double, 3> nearest{}, farthest{};
  std::array<bool, 3> apart{}, cuts{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double low = box.lower[axis], high = box.upper[axis];
    if (leaf.kind == RegionLeaf::Kind::ball) {
      nearest[a] = nearest_square(leaf.center[axis], low, high);
      farthest[a] = farthest_square(leaf.center[axis], low, high);
    } else {
      apart[a] = leaf.bounds.lower[axis] > high || low > leaf.bounds.upper[axis];
      cuts[a] = low < leaf.bounds.lower[axis] + regions.margin_ || high > leaf.bounds.upper[axis] - regions.margin_;
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    nearest_[a] = nearest[b] + nearest[c];
    farthest_[a] = farthest[b] + farthest[c];
    apart_[a] = apart[b] || apart[c];
    cuts_[a] = cuts[b] || cuts[c];
  }
}

Region BoxRegions::classify(int axis, double low, double high) const {
  const auto a = static_cast<std::size_t>(axis);
  if (leaf_->kind == RegionLeaf::Kind::ball) {
    if (nearest_[a] + nearest_square(leaf_->center[axis], low, high) > leaf_->outer_square) return Region::outside;
    return farthest_[a] + farthest_square(leaf_->center[axis], low, high) < leaf_->inner_square ? Region::inside
                                                                                                : Region::straddles;
  }
  const double begin = leaf_->bounds.lower[axis], end = leaf_->bounds.upper[axis];
  if (apart_[a] || begin > high || low > end) return Region::outside;
  if (leaf_->kind == RegionLeaf::Kind::upright_box) {
    const bool within = low >= begin + regions_->margin_ && high <= end - regions_->margin_;
    return within && !cuts_[a] ? Region::inside : Region::straddles;
  }
  Box3 part = *box_;
  part.lower[axis] = low;
  part.upper[axis] = high;
  return regions_->classify(*leaf_, part);
}

}  // namespace tenon::cells
