#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "accel/cells/certainty.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/planes_recorder.h"
#include "accel/cells/walls_recorder.h"
#include "primitive/wall_part.h"
#include "tenon/math/rounding.h"

namespace tenon::cells {

/// Makes a RevolvedRecord of what a turned outline comes to in a box.
///
/// The distance from the axis is off by no more than the place. What spans() says of a wall, over the length of its
/// gradient, errs near it by that and by roundings of products of coordinates. Of a ray that starts on the wall, whose
/// own value may be as far off and is subtracted, it errs by three times that; twice leaves a quarter of what is
/// certain.
class RevolvedRecorder {
 public:
  /// @param center  what the record's places are relative to
  /// @param box     of the world: where the part is right
  /// @return whether there is a record
  bool record(const Leaf& leaf, const CellScale& scale, const Vec3& center, RevolvedPart part, const Box3& box) {
    const Placement& placement = leaf.placement;
    const Certainty certainty(leaf, scale);
    const Vec3 middle = placement.point_to_local(box.center()), errors = certainty.place();
    const double most = certainty.most_stretch();
    double extent = most * (scale.reach + length(placement.world_origin()));
    for (WallPart::Wall& wall : part.walls) {
      const bool runs_away = wall.is_arc() ? wall.bulge > 0 : wall.chord().y >= 0;
      if (!runs_away) reverse(wall);
      extent = std::max(extent, length(wall.from));
    }
    const double place_error = std::hypot(errors.x, errors.y) + errors.z;
    const double error = (1 + 0x1p-10) * place_error + gamma(64) * extent;

    walls_ = WallsRecorder(RevolvedRecord::walls, RevolvedRecord::wall_size, part);
    std::vector<double>& values = walls_.values();
    walls_.put_place(box.center() - center, placement.local_from_world_linear());
    walls_.put(WallsRecord::known, part.place - Vec2{0, middle.z});
    walls_.put(RevolvedRecord::middle, Vec2{middle.x, middle.y});
    values[RevolvedRecord::doubt] = 2 * error;
    values[RevolvedRecord::least] = certainty.least_slope(2 * error);
    // A crossing is off by the resolution along the ray, and by its error.
    values[RevolvedRecord::margin] = values[RevolvedRecord::place_margin] = 4 * (most * scale.resolution + error);
    if (!(values[RevolvedRecord::least] <= PlanesRecorder::most_slope * most)) return false;
    return walls_.put_walls(part, [&](const WallPart::Wall& wall, std::size_t at) {
      if (!wall.is_arc()) return true;
      const double radius = 0.5 / WallsRecorder::curvature_of(wall);
      values[at + RevolvedRecord::center_radius] = wall.from.x - radius / wall.gradient_length() * wall.normal({}).x;
      return error < radius / 0x1p10;
    });
  }
  const std::vector<double>& values() { return walls_.values(); }

 private:
  static void reverse(OutlineEdge& edge) {
    std::swap(edge.from, edge.to);
    edge.bulge = -edge.bulge;
  }

  WallsRecorder walls_;
};

}  // namespace tenon::cells
