#include "accel/cells/leaf_pieces.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "accel/cells/cell_cost.h"
#include "accel/cells/planes_recorder.h"
#include "primitive/lists.h"
#include "tenon/math/rounding.h"

namespace tenon::cells {

bool LeafPieces::may_have(const CsgTree& tree, const Leaf& leaf) {
  return visit(tree.primitives.lists(), leaf.primitive, [](const auto& primitive) {
    const LocalBox box{};
    return requires(std::vector<Plane> & planes) {
      primitive.planes_within(box, planes);
    }
    || requires(SweptPart & part) {
      primitive.walls_within(box, most_walls, part);
    }
    || requires(TwistedPart & part) {
      primitive.walls_within(box, most_walls, part);
    }
    || requires(RevolvedPart & part) {
      primitive.walls_within(box, most_walls, part);
    };
  });
}

bool LeafPieces::find(LeafId id, const Box3& box) {
  const Leaf& leaf = tree_[id];
  box_ = box;
  leaf_ = &leaf;
  const LocalBox local = leaf.placement.to_local(box);
  return find_planes(leaf, local) || find_walls(leaf, local);
}

bool LeafPieces::find_walls(const Leaf& leaf, const LocalBox& local) {
  return visit(tree_.primitives.lists(), leaf.primitive, [&](const auto& primitive) {
    if constexpr (requires { primitive.walls_within(local, most_walls, swept_); }) {
      kind_ = RecordKind::outline_piece;
      return primitive.walls_within(local, most_walls, swept_) && outline_.record(leaf, scale_, center_, swept_, box_);
    } else if constexpr (requires { primitive.walls_within(local, most_walls, twisted_); }) {
      kind_ = RecordKind::twisted_piece;
      return primitive.walls_within(local, most_walls, twisted_) &&
             twisted_record_.record(leaf, scale_, center_, twisted_, box_);
    } else if constexpr (requires { primitive.walls_within(local, most_walls, turned_); }) {
      kind_ = RecordKind::revolved_piece;
      return primitive.walls_within(local, most_walls, turned_) &&
             revolved_.record(leaf, scale_, center_, turned_, box_);
    } else {
      return false;
    }
  });
}

double LeafPieces::price() const {
  if (kind_ == RecordKind::outline_piece) return CellCost::of_outline(swept_.walls.size());
  if (kind_ == RecordKind::twisted_piece) return CellCost::of_twisted(twisted_.walls.size());
  if (kind_ == RecordKind::revolved_piece) return CellCost::of_revolved(turned_.walls.size());
  return CellCost::of_leaf(kind_, 0);
}

const std::vector<double>& LeafPieces::values() {
  if (kind_ == RecordKind::outline_piece) return outline_.values();
  if (kind_ == RecordKind::twisted_piece) return twisted_record_.values();
  return kind_ == RecordKind::revolved_piece ? revolved_.values() : values_;
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
  if (kind_ == RecordKind::outline_piece) return surface_of_outline();
  // Its walls go through all of the box, more or less.
  if (kind_ == RecordKind::twisted_piece) return box_;
  return kind_ == RecordKind::revolved_piece ? surface_of_revolved() : surface_of_planes();
}

// @param parts  boxes of the leaf's frame that it lies in
Box3 LeafPieces::surface_of(std::span<const Box3> parts) const {
  const Affine3& map = leaf_->placement.world_from_local();
  Box3 all;
  for (const Box3& part : parts) {
    if (part.is_empty()) continue;
    const Vec3 middle = map.point(part.center()), half = 0.5 * part.size();
    const Vec3 reach{dot(abs(map.row(0)), half), dot(abs(map.row(1)), half), dot(abs(map.row(2)), half)};
    all = hull(all, {middle - reach, middle + reach});
  }
  // Terms no larger than the scene, each of which rounds a few times; the box of the cell is grown by much more.
  return intersection(grown(all, 0x1p-40 * scale_.reach), box_);
}

// A box around each wall, and one of each cap, which may be there for all the box.
Box3 LeafPieces::surface_of_outline() const {
  const Box3 bounds = leaf_->placement.to_local(box_).bounds;
  std::vector<Box3> parts;
  for (const OutlineEdge& wall : swept_.walls) {
    const auto scaled = [&](double v, bool is_low) {
      return (v < 0) == is_low ? v * swept_.most_scale : v * swept_.least_scale;
    };
    const Box3 around{{scaled(wall.lower.x, true), scaled(wall.lower.y, true), swept_.low},
                      {scaled(wall.upper.x, false), scaled(wall.upper.y, false), swept_.high}};
    parts.push_back(intersection(around, bounds));
  }
  for (const double cap : {swept_.low, swept_.high}) {
    Box3 face = bounds;
    face.lower.z = face.upper.z = cap;
    parts.push_back(intersection(face, bounds));
  }
  return surface_of(parts);
}

// What of the box lies in the ring that a wall's box makes: as far along x as y lets it.
Box3 LeafPieces::surface_of_revolved() const {
  const Box3 bounds = leaf_->placement.to_local(box_).bounds;
  std::vector<Box3> parts;
  for (const OutlineEdge& wall : turned_.walls) {
    Box3 part = intersection(
        bounds, {{-wall.upper.x, -wall.upper.x, wall.lower.y}, {wall.upper.x, wall.upper.x, wall.upper.y}});
    if (part.is_empty()) continue;
    for (const auto& [along, across] : {std::pair{0, 1}, std::pair{1, 0}}) {
      const double most = std::max(std::fabs(part.lower[across]), std::fabs(part.upper[across]));
      const double least = std::sqrt(std::max(wall.lower.x * wall.lower.x - most * most, 0.0));
      if (part.lower[along] >= 0) part.lower[along] = std::max(part.lower[along], least);
      if (part.upper[along] <= 0) part.upper[along] = std::min(part.upper[along], -least);
    }
    parts.push_back(part);
  }
  return surface_of(parts);
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
