#include "accel/cells/leaf_pieces.h"

#include <cmath>

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
  const PlanarPart part = visit(tree_.primitives.lists(), leaf.primitive, [&](const auto& primitive) {
    if constexpr (requires { primitive.planes_within(leaf.placement.to_local(box), planes_); }) {
      return primitive.planes_within(leaf.placement.to_local(box), planes_);
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
  box_ = box;
  values_ = record.values();
  return record.least_slope() <= PlanesRecorder::most_slope;
}

// Where n·p = d goes through a box: along each axis as far as the other two terms let it.
Box3 LeafPieces::surface() const {
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
