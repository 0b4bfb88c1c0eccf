#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "accel/cells/certainty.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/planes_recorder.h"
#include "accel/cells/walls_recorder.h"
#include "primitive/wall_part.h"
#include "tenon/math/rounding.h"

namespace tenon::cells {

/// Makes an OutlineRecord of what a swept outline comes to in a box.
///
/// What spans() says of a wall errs by what its place errs, and by roundings of products of coordinates. Those of a
/// segment amount to twice the error of place; those of an arc are Certainty::arc_error() over the length of its
/// gradient, which is at least half the chord.
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
    // Of the outline, as far as its walls are there: a place near them moves with the scale by as much.
    double reach = 0;
    for (const OutlineEdge& wall : part.walls) reach = std::max(reach, length(wall.from) + length(wall.chord()));
    extent = std::max(extent, part.most_scale * reach);
    error_ = std::hypot(errors.x, errors.y) + slope * reach * errors.z;

    walls_ = WallsRecorder(OutlineRecord::walls, OutlineRecord::wall_size, part);
    std::vector<double>& values = walls_.values();
    walls_.put_place(box.center() - center, map);
    values[OutlineRecord::low] = part.low - middle.z;
    values[OutlineRecord::high] = part.high - middle.z;
    values[OutlineRecord::least_to_caps] = certainty.least_slope(errors.z);
    values[OutlineRecord::least] = certainty.least_slope(2 * error_ + gamma(16) * extent);
    // A crossing is off by the resolution along the ray, and by its error.
    const double margin = 4 * (across * (1 + slope * reach) * scale.resolution + error_);
    values[OutlineRecord::margin] = margin;
    values[OutlineRecord::place_margin] = margin / part.least_scale;
    values[OutlineRecord::scale] = part.scale + part.scale_slope * middle.z;
    values[OutlineRecord::scale_slope] = part.scale_slope;
    const bool are_caps_certain =
        values[OutlineRecord::least_to_caps] <= PlanesRecorder::most_slope * length(map.row(2));
    if (!are_caps_certain || !(values[OutlineRecord::least] <= PlanesRecorder::most_slope * across)) return false;
    walls_.put(WallsRecord::known, part.place);
    walls_.put(OutlineRecord::known_offset, values[OutlineRecord::scale] * part.place - Vec2{middle.x, middle.y});
    return walls_.put_walls(part, [&](const WallPart::Wall& wall, std::size_t at) {
      walls_.put(at + OutlineRecord::offset, values[OutlineRecord::scale] * wall.from - Vec2{middle.x, middle.y});
      walls_.put(at + OutlineRecord::from, wall.from);
      values[at + OutlineRecord::index] = wall.index;
      return !wall.is_arc() || add_arc(certainty, part, wall, extent, at);
    });
  }
  const std::vector<double>& values() { return walls_.values(); }

 private:
  bool add_arc(const Certainty& certainty, const SweptPart& part, const OutlineEdge& wall, double extent,
               std::size_t at) {
    const double radius = 0.5 / WallsRecorder::curvature_of(wall);
    const double chord = part.most_scale * length(wall.chord());
    const double error = Certainty::arc_error(chord, wall.bulge, error_ + gamma(8) * extent) / wall.gradient_length();
    // q over its gradient times the diameter is the square of the distance from the centre, less that of the radius.
    if (!(error < radius / 0x1p10)) return false;
    const double diameter = 2 * radius, tilt = 1 + std::fabs(part.scale_slope) * diameter;
    walls_.values()[at + OutlineRecord::graze] = tilt * certainty.graze(diameter * error) / (diameter * diameter);
    walls_.values()[at + OutlineRecord::start] = least_certain_start(certainty, part, wall, extent);
    return true;
  }

  /// How large the coefficient of t² of curvature |p|² + normal·p scale has to be along a ray that starts on an arc,
  /// over |direction|², so that where it meets the arc's circle again is certain (solve_deflated).
  ///
  /// The bounds are those of Prism::Line, over the length of the gradient. With a bulge of at most 1 the curvature
  /// times the chord is at most 1, and so is the length of the normal; p on the arc is no longer than the chord, at its
  /// scale.
  static double least_certain_start(const Certainty& certainty, const SweptPart& part, const OutlineEdge& wall,
                                    double extent) {
    const double k = WallsRecorder::curvature_of(wall), grows = std::fabs(part.scale_slope), s = part.most_scale;
    const double from = length(wall.from);
    const Vec3 place_errors = certainty.place(), direction_errors = certainty.direction();
    // Of a direction of length 1 in the world.
    const double ds = grows * certainty.most_stretch(), d = certainty.most_stretch() + ds * from;
    const double ds_error = grows * direction_errors.z + gamma(4) * ds;
    const double d_error = std::hypot(direction_errors.x, direction_errors.y) + ds_error * from + gamma(2) * d;
    const double s_error = grows * place_errors.z + gamma(8) * (1 + s + grows * extent);
    const double place = std::hypot(place_errors.x, place_errors.y) + s_error * from + gamma(4) * extent;
    const double p = s * length(wall.chord()) + place;
    const double a_error =
        k * (2 * d + d_error) * d_error + 2 * (ds * d_error + d * ds_error) + gamma(16) * (k * d * d + 2 * d * ds);
    const double b_error = 4 * s * d_error + 2 * (k * d * place + d * s_error + p * ds_error + ds * place) +
                           gamma(16) * (4 * d * s + d * ds + 2 * p * ds);
    return certainty.least_certain_deflated(a_error, b_error);
  }

  double error_ = 0;  // of a place across the axis
  WallsRecorder walls_;
};

}  // namespace tenon::cells
