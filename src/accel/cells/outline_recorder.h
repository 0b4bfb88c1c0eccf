#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "accel/cells/certainty.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/planes_recorder.h"
#include "primitive/wall_part.h"

namespace tenon::cells {

/// Makes an OutlineRecord of what a swept outline comes to in a box.
///
/// What spans() says of a wall errs by what its place errs, and by roundings of products of coordinates. Those of a
/// segment amount to twice the error of place; those of an arc, of q over the length of its gradient, to at most 7
/// times: the terms of that error are 2 |p| + |chord| in size, with p on the arc, which is no longer than 1.6 chords
/// where the bulge is at most 1, and the arcs of larger bulge are left out.
class OutlineRecorder {
 public:
  /// @param center  what the record's places are relative to
  /// @param box     of the world: where the part is right
  /// @return whether there is a record
  bool record(const Leaf& leaf, const CellScale& scale, const Vec3& center, const WallPart& part, const Box3& box) {
    const Placement& placement = leaf.placement;
    const Certainty certainty(leaf, scale);
    const Affine3 map = placement.local_from_world_linear();
    const Vec3 middle = placement.point_to_local(box.center());
    const Vec3 errors = certainty.place();
    const double across = std::hypot(length(map.row(0)), length(map.row(1)));
    const double slope = std::fabs(part.scale_slope);
    double extent = across * (scale.reach + length(placement.world_origin()));
    for (const OutlineEdge& wall : part.walls) extent = std::max(extent, part.most_scale * length(wall.from));
    error_ = std::hypot(errors.x, errors.y) + slope * (extent / part.least_scale) * errors.z;

    values_.assign(OutlineRecord::walls + OutlineRecord::wall_size * part.walls.size(), 0);
    put(OutlineRecord::center, box.center() - center);
    for (int i = 0; i < 3; ++i) put(OutlineRecord::map + static_cast<std::size_t>(3 * i), map.row(i));
    values_[OutlineRecord::low] = part.low - middle.z;
    values_[OutlineRecord::high] = part.high - middle.z;
    values_[OutlineRecord::least_to_caps] = certainty.least_slope(errors.z);
    values_[OutlineRecord::least] = certainty.least_slope(2 * error_ + gamma(16) * extent);
    // A crossing is off by the resolution along the ray, and by its error.
    const double margin = 4 * (across * (1 + slope * extent / part.least_scale) * scale.resolution + error_);
    values_[OutlineRecord::margin] = margin;
    values_[OutlineRecord::place_margin] = margin / part.least_scale;
    values_[OutlineRecord::scale] = part.scale + part.scale_slope * middle.z;
    values_[OutlineRecord::scale_slope] = part.scale_slope;
    values_[OutlineRecord::is_inside] = part.is_inside ? 1 : 0;
    values_[OutlineRecord::count] = static_cast<double>(part.walls.size());
    const bool are_caps_certain =
        values_[OutlineRecord::least_to_caps] <= PlanesRecorder::most_slope * length(map.row(2));
    if (!are_caps_certain || !(values_[OutlineRecord::least] <= PlanesRecorder::most_slope * across)) return false;
    greatest_radius_ = 0;
    std::size_t at = OutlineRecord::walls;
    for (const OutlineEdge& wall : part.walls) {
      if (!add(certainty, part, wall, {middle.x, middle.y}, extent, at)) return false;
      at += OutlineRecord::wall_size;
    }
    return true;
  }
  /// The numbers of the record, with what takes long to find: from which directions a start on an arc is certain.
  const std::vector<double>& finish(const Leaf& leaf, const CellScale& scale) {
    if (greatest_radius_ == 0) return values_;
    const bool is_straight = values_[OutlineRecord::scale_slope] == 0;
    values_[OutlineRecord::start] = is_straight ? Certainty(leaf, scale).least_certain_start(greatest_radius_)
                                                : std::numeric_limits<double>::infinity();
    return values_;
  }

 private:
  bool add(const Certainty& certainty, const WallPart& part, const OutlineEdge& wall, const Vec2& middle, double extent,
           std::size_t at) {
    const Vec2 w = wall.chord(), along = 1 / length(w) * w, normal = 1 / wall.gradient_length() * wall.normal({});
    const Vec2 offset = values_[OutlineRecord::scale] * wall.from - middle, known = part.place - wall.from;
    const double curvature = wall.bulge / wall.gradient_length(), at_place = wall.distance(known);
    if (!std::isfinite(normal.x + normal.y + along.x + curvature) || std::fabs(wall.bulge) > 1) return false;
    // The place that is known is told from the wall, with as much again to spare.
    if (!(std::fabs(at_place) > 4 * values_[OutlineRecord::place_margin])) return false;
    put(at + OutlineRecord::offset, offset);
    put(at + OutlineRecord::from, wall.from);
    put(at + OutlineRecord::normal, normal);
    put(at + OutlineRecord::chord, along);
    put(at + OutlineRecord::place, known);
    values_[at + OutlineRecord::length] = length(w);
    values_[at + OutlineRecord::curvature] = curvature;
    values_[at + OutlineRecord::at_place] = at_place;
    if (curvature == 0) return true;
    const double radius = 0.5 / std::fabs(curvature), error = part.most_scale * (8 * error_ + gamma(64) * extent);
    // q over its gradient times the diameter is the square of the distance from the centre, less that of the radius.
    if (!(error < radius / 0x1p10)) return false;
    const double diameter = 2 * radius, tilt = 1 + std::fabs(part.scale_slope) * diameter;
    values_[at + OutlineRecord::graze] = tilt * certainty.graze(diameter * error) / (diameter * diameter);
    greatest_radius_ = std::max(greatest_radius_, radius);
    return true;
  }

  void put(std::size_t at, const Vec3& v) {
    for (int i = 0; i < 3; ++i) values_[at + static_cast<std::size_t>(i)] = v[i];
  }
  void put(std::size_t at, const Vec2& v) {
    values_[at] = v.x;
    values_[at + 1] = v.y;
  }

  double error_ = 0;            // of a place across the axis
  double greatest_radius_ = 0;  // of an arc
  std::vector<double> values_;
};

}  // namespace tenon::cells
