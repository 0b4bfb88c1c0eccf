#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "accel/cells/certainty.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/planes_recorder.h"
#include "accel/cells/walls_recorder.h"
#include "math/quarter_turns.h"
#include "primitive/wall_part.h"
#include "tenon/math/rounding.h"

namespace tenon::cells {

/// Makes a TwistedRecord of what a twisted outline comes to in a box.
///
/// What TwistedLine makes of a place that is off by e, in a segment's function over the length of its gradient, is √2 e
/// at most. An arc's function is bulge p·(p - chord) + flatness cross(chord, p) over (1 + bulge²) / 2 chords. Near an
/// arc of at most half a circle p and p - chord are together no longer than √2 chords: (4 bulge + √2 (1 - bulge²)) / (1
/// + bulge²) e, below 2.5 e. Its balls do not know that the errors of both coordinates by the turn go together, which
/// makes √2 times as much of them; nor that those of a scale do in the place and in what it is compared with, the
/// scaled ends of a wall, which may be far away. The bound of a crossing is two and a half times the error over the
/// slope. With twice the error there is room for 1.6 times as much.
class TwistedRecorder {
 public:
  /// @param center  what the record's places are relative to
  /// @param box     of the world: where the part is right
  /// @return whether there is a record
  bool record(const Leaf& leaf, const CellScale& scale, const Vec3& center, const TwistedPart& part, const Box3& box) {
    const Placement& placement = leaf.placement;
    const Certainty certainty(leaf, scale);
    const Affine3 map = placement.local_from_world_linear();
    const Vec3 middle = placement.point_to_local(box.center()), errors = certainty.place();
    const double most = certainty.most_stretch();
    const double growth = std::max(std::fabs(part.scale_slope.x), std::fabs(part.scale_slope.y));
    const double extent = most * (scale.reach + length(placement.world_origin()));
    double reach = part.reach;
    for (const OutlineEdge& wall : part.walls) reach = std::max(reach, length(wall.from) + length(wall.chord()));
    // Of a place in the plane of the outline: by that of the point, by the scale and the turn there, and by roundings.
    const double across = (std::hypot(errors.x, errors.y) + 3 * growth * reach * errors.z) / part.least_scale;
    const double turn = std::fabs(part.turn) * errors.z + gamma(16) * (1 + part.turn_to_here) + sine_cosine_error;
    const double place_error = across + part.reach * turn + gamma(64) * (extent / part.least_scale + reach);
    const bool has_arcs = std::any_of(part.walls.begin(), part.walls.end(), [](const auto& w) { return w.is_arc(); });
    const double error = (has_arcs ? 2.5 : 1.5) * place_error;

    walls_ = WallsRecorder(TwistedRecord::walls, TwistedRecord::wall_size, part);
    std::vector<double>& values = walls_.values();
    walls_.put_place(box.center() - center, map);
    walls_.put(WallsRecord::known, part.place);
    walls_.put(TwistedRecord::middle, Vec3{middle.x, middle.y, middle.z - part.middle});
    values[TwistedRecord::low] = part.low - part.middle;
    values[TwistedRecord::high] = part.high - part.middle;
    values[TwistedRecord::least_to_caps] = certainty.least_slope(errors.z);
    values[TwistedRecord::turn] = part.turn;
    walls_.put(TwistedRecord::scale, part.scale);
    walls_.put(TwistedRecord::scale_slope, part.scale_slope);
    values[TwistedRecord::growth] = growth;
    values[TwistedRecord::least_scale] = part.least_scale;
    values[TwistedRecord::reach] = part.reach;
    values[TwistedRecord::doubt] = 2 * error;
    values[TwistedRecord::least] = certainty.least_slope(2 * error);
    // How fast a place may move along a ray. A crossing is off by the resolution along the ray, and by its error.
    const double speed = most * ((1 + growth * part.reach) / part.least_scale + std::fabs(part.turn) * part.reach);
    values[TwistedRecord::margin] = values[TwistedRecord::place_margin] = 4 * (speed * scale.resolution + error);
    if (!(values[TwistedRecord::least_to_caps] <= PlanesRecorder::most_slope * length(map.row(2)))) return false;
    if (!(values[TwistedRecord::least] <= PlanesRecorder::most_slope * speed)) return false;
    return walls_.put_walls(part, [&](const WallPart::Wall& wall, std::size_t at) {
      const double away = part.reach + length(wall.from);
      values[at + TwistedRecord::steepness] = wall.steepness(away) / wall.gradient_length();
      return !wall.is_arc() || error < 0.5 / WallsRecorder::curvature_of(wall) / 0x1p10;
    });
  }
  const std::vector<double>& values() { return walls_.values(); }

 private:
  WallsRecorder walls_;
};

}  // namespace tenon::cells
