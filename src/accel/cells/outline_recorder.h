#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "accel/cells/certainty.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/planes_recorder.h"
#include "accel/cells/walls_recorder.h"
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
  bool record(const Leaf& leaf, const CellScale& scale, const Vec3& center, const SweptPart& part, const Box3& box) {
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

    walls_ = WallsRecorder(OutlineRecord::walls, OutlineRecord::wall_size, part);
    std::vector<double>& values = walls_.values();
    walls_.put_place(box.center() - center, map);
    values[OutlineRecord::low] = part.low - middle.z;
    values[OutlineRecord::high] = part.high - middle.z;
    values[OutlineRecord::least_to_caps] = certainty.least_slope(errors.z);
    values[OutlineRecord::least] = certainty.least_slope(2 * error_ + gamma(16) * extent);
    // A crossing is off by the resolution along the ray, and by its error.
    const double margin = 4 * (across * (1 + slope * extent / part.least_scale) * scale.resolution + error_);
    values[OutlineRecord::margin] = margin;
    values[OutlineRecord::place_margin] = margin / part.least_scale;
    values[OutlineRecord::scale] = part.scale + part.scale_slope * middle.z;
    values[OutlineRecord::scale_slope] = part.scale_slope;
    const bool are_caps_certain =
        values[OutlineRecord::least_to_caps] <= PlanesRecorder::most_slope * length(map.row(2));
    if (!are_caps_certain || !(values[OutlineRecord::least] <= PlanesRecorder::most_slope * across)) return false;
    walls_.put(WallsRecord::known, part.place);
    walls_.put(OutlineRecord::known_offset, values[OutlineRecord::scale] * part.place - Vec2{middle.x, middle.y});
    greatest_radius_ = 0;
    return walls_.put_walls(part, [&](const OutlineEdge& wall, std::size_t at) {
      walls_.put(at + OutlineRecord::offset, values[OutlineRecord::scale] * wall.from - Vec2{middle.x, middle.y});
      walls_.put(at + OutlineRecord::from, wall.from);
      return !wall.is_arc() || add_arc(certainty, part, wall, extent, at);
    });
  }
  /// The numbers of the record, with what takes long to find: from which directions a start on an arc is certain.
  const std::vector<double>& finish(const Leaf& leaf, const CellScale& scale) {
    std::vector<double>& values = walls_.values();
    if (greatest_radius_ == 0) return values;
    const bool is_straight = values[OutlineRecord::scale_slope] == 0;
    values[OutlineRecord::start] = is_straight ? Certainty(leaf, scale).least_certain_start(greatest_radius_)
                                               : std::numeric_limits<double>::infinity();
    return values;
  }

 private:
  bool add_arc(const Certainty& certainty, const SweptPart& part, const OutlineEdge& wall, double extent,
               std::size_t at) {
    const double radius = 0.5 / WallsRecorder::curvature_of(wall);
    const double error = part.most_scale * (8 * error_ + gamma(64) * extent);
    // q over its gradient times the diameter is the square of the distance from the centre, less that of the radius.
    if (!(error < radius / 0x1p10)) return false;
    const double diameter = 2 * radius, tilt = 1 + std::fabs(part.scale_slope) * diameter;
    walls_.values()[at + OutlineRecord::graze] = tilt * certainty.graze(diameter * error) / (diameter * diameter);
    greatest_radius_ = std::max(greatest_radius_, radius);
    return true;
  }

  double error_ = 0;            // of a place across the axis
  double greatest_radius_ = 0;  // of an arc
  WallsRecorder walls_;
};

}  // namespace tenon::cells
