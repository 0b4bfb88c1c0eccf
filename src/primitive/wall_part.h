#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "primitive/local_box.h"
#include "primitive/outline_edges.h"

namespace tenon {

/// What an outline comes to in the part of its plane that a box lies over: the walls there, and a place of which is
/// known whether it is inside. So is any other of that part, if the straight way from there to `place` crosses an even
/// number of walls and the place is inside, or an odd number and it is not.
struct WallPart {
  struct Wall : OutlineEdge {
    std::uint32_t index = 0;  ///< of the edge
  };

  std::vector<Wall> walls;
  Vec2 place;
  bool is_inside = false;

  /// Chooses the place, of a few of the box the one that is farthest from all walls.
  /// @param place_under  of the outline's plane, of a point of the box
  template <class PlaceUnder>
  void choose_place(const LocalBox& box, const OutlineEdges& edges, const PlaceUnder& place_under) {
    double clearance = -1;
    for (int i = -1; i < 8; ++i) {
      const Vec2 at = place_under(i < 0 ? box.center : 0.5 * (box.center + box.corner(i)));
      double nearest = HUGE_VAL;
      for (const OutlineEdge& wall : walls) nearest = std::min(nearest, std::fabs(wall.distance(at - wall.from)));
      if (nearest <= clearance) continue;
      clearance = nearest;
      place = at;
    }
    is_inside = edges.contains(place);
  }
};

/// Of a swept outline: a point p lies over (p.x, p.y) / (scale + scale_slope p.z).
struct SweptPart : WallPart {
  double low = 0, high = 0;  ///< z of the caps
  double scale = 1, scale_slope = 0;
  double least_scale = 1, most_scale = 1;  ///< over the box; positive
};

/// Of an outline that turns and is scaled on its way along z. With z counted from `middle`, a point lies over the place
/// that (x / (scale.x + scale_slope.x z), y / (scale.y + scale_slope.y z)) comes to when it is turned by `turn` z. The
/// plane is turned so that this is no turn at `middle`.
struct TwistedPart : WallPart {
  /// How far the plane turns from `middle` to an end of the box, at most, in radians.
  static constexpr double most_turn = 0.5;

  double low = 0, high = 0;  ///< z of the caps
  double middle = 0;         ///< z of the box's middle
  double turn = 0;           ///< radians per length, counterclockwise
  Vec2 scale{1, 1}, scale_slope;
  double least_scale = 1;     ///< over the box; positive
  double reach = 0;           ///< how far from the axis the places of the box are, at most
  bool is_too_large = false;  ///< where there is none: the box is, whose parts may have one
  double turn_to_here = 0;    ///< in radians, from the bottom: what the turn rounds by goes by that
};

/// Of an outline that is turned around z: a point lies over (its distance from z, z).
struct RevolvedPart : WallPart {};

}  // namespace tenon
