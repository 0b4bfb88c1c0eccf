#include "accel/cells/leaf_pieces.h"

#include <algorithm>
#include <cmath>

#include "accel/cells/cell_cost.h"
#include "accel/cells/planes_recorder.h"
#include "primitive/lists.h"

namespace tenon::cells {

bool LeafPieces::may_have(const CsgTree& tree, const Leaf& leaf) {
  return visit(tree.primitives.lists(), leaf.primitive, [](const auto& primitive) {
    return requires(const LocalBox& box, std::vector<Plane>& planes) {
      primitive.planes_within(box, planes);
    };
  });
}

bool LeafPieces::find(LeafId id, const Box3& box) {
  const Leaf& leaf = tree_[id];
  box_ = box;
  const LocalBox local = leaf.placement.to_local(box);
  return find_planes(leaf, local) || find_walls(leaf, local);
}

bool LeafPieces::find_walls(const Leaf& leaf, const LocalBox& local) {
  const bool are_few = visit(tree_.primitives.lists(), leaf.primitive, [&](const auto& primitive) {
    if constexpr (requires { primitive.walls_within(local, most_walls, walls_); }) {
      return primitive.walls_within(local, most_walls, walls_);
    } else {
      return false;
    }
  });
  kind_ = RecordKind::outline_piece;
  leaf_ = &leaf;
  return are_few && outline_.record(leaf, scale_, center_, walls_, box_);
}

double LeafPieces::price() const {
  return kind_ == RecordKind::outline_piece ? CellCost::of_outline(walls_.walls.size()) : CellCost::of_leaf(kind_, 0);
}

bool LeafPieces::find_planes(const Leaf& leaf, const LocalBox& local) {
  const PlanarPart part = visit(tree_.primitives.lists(), leaf.primitive, [&](const auto& primitive) {
    if constexpr (requires { primitive.planes_within(local, planes_); }) {
      return primitive.planes_within(local, planes_);
    } else {
      return PlanarPart::unknown;
    }
  });
  if (part == PlanarPart::unknown) return false;
  // What spans() computes of a plane rounds terms no larger than the place on the ray, which the record accounts for,
  // and the solid's own coordinates, whose images no coordinate of the scene exceeds.
  const Affine3 map = leaf.placement.local_from_world_linear();
  const Vec3 most = Vec3{scale_.reach, scale_.reach, scale_.reach} + abs(leaf.placement.world_origin());
  const Vec3 extent{dot(abs(map.row(0)), most), dot(abs(map.row(1)), most), dot(abs(map.row(2)), most)};
  PlanesRecorder record(leaf, scale_, center_);
  for (const Plane& plane : planes_) record.add(plane, gamma(16) * dot(abs(plane.normal), extent));
  if (part == PlanarPart::above_any) record.invert();
  kind_ = part == PlanarPart::above_any ? RecordKind::notch_piece : RecordKind::convex_piece;
  values_ = record.values();
  return record.least_slope() <= PlanesRecorder::most_slope;
}

Box3 LeafPieces::surface() const {
  return kind_ == RecordKind::outline_piece ? surface_of_walls() : surface_of_planes();
}

// In the leaf's frame a box around the walls, and one of each cap, which may be there for all the box.
Box3 LeafPieces::surface_of_walls() const {
  const Placement& placement = leaf_->placement;
  const Box3 bounds = placement.to_local(box_).bounds;
  Box3 all;
  const auto take = [&](const Box3& local) {
    const Box3 within = intersection(local, bounds);
    if (within.is_empty()) return;
    const Affine3& map = placement.world_from_local();
    const Vec3 middle = map.point(within.center()), half = 0.5 * within.size();
    const Vec3 reach{dot(abs(map.row(0)), half), dot(abs(map.row(1)), half), dot(abs(map.row(2)), half)};
    all = hull(all, {middle - reach, middle + reach});
  };
  for (const OutlineEdge& wall : walls_.walls) {
    Box3 around = bounds;
    const auto scaled = [&](double v, bool is_low) {
      return (v < 0) == is_low ? v * walls_.most_scale : v * walls_.least_scale;
    };
    around.lower.x = scaled(wall.lower.x, true);
    around.lower.y = scaled(wall.lower.y, true);
    around.upper.x = scaled(wall.upper.x, false);
    around.upper.y = scaled(wall.upper.y, false);
    around.lower.z = std::max(around.lower.z, walls_.low);
    around.upper.z = std::min(around.upper.z, walls_.high);
    take(around);
  }
  for (const double cap : {walls_.low, walls_.high}) {
    Box3 face = bounds;
    face.lower.z = face.upper.z = cap;
    take(face);
  }
  // Terms no larger than the scene, each of which rounds a few times; the box of the cell is grown by much more.
  return intersection(grown(all, 0x1p-40 * scale_.reach), box_);
}

// Where n·p = d goes through a box: along each axis as far as the other two terms let it.
Box3 LeafPieces::surface_of_planes() const {
  Box3 all;
  for (std::size_t at = ConvexRecord::planes; at < values_.size(); at += ConvexRecord::plane_size) {
    const Vec3 n{values_[at], values_[at + 1], values_[at + 2]};
    const Vec3 low = box_.lower - center_, high = box_.upper - center_;
    // Terms no larger than the scene, each of which rounds a few times.
    const double slip = 0x1p-40 * scale_.reach;
    Box3 face = box_;
    for (int axis = 0; axis < 3; ++axis) {
      // So steep along the axis that the quotient is no more than 2^10 times as far off.
      if (std::fabs(n[axis]) < 0x1p-10) continue;
      double least = values_[at + 3], most = values_[at + 3];
      for (int other = 0; other < 3; ++other) {
        if (other == axis) continue;
        least -= std::max(n[other] * low[other], n[other] * high[other]);
        most -= std::min(n[other] * low[other], n[other] * high[other]);
      }
      const double a = least / n[axis], b = most / n[axis], margin = 0x1p10 * slip;
      face.lower[axis] = std::max(face.lower[axis], std::min(a, b) - margin + center_[axis]);
      face.upper[axis] = std::min(face.upper[axis], std::max(a, b) + margin + center_[axis]);
    }
    if (!face.is_empty()) all = hull(all, face);
  }
  return all;
}

}  // namespace tenon::cells
