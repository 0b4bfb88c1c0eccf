#pragma once

#include <vector>

#include "primitive/outline_edges.h"

namespace tenon {

/// A swept outline within a box: the walls that go through the box, and what they bound.
///
/// A point p lies over (p.x, p.y) / (scale + scale_slope p.z) of the outline's plane. Between the caps a point of the
/// box is inside if the straight way to there from `place` crosses an even number of walls and the place is inside, or
/// an odd number and it is not. All of that way lies over the box, so no other wall is in it.
struct WallPart {
  std::vector<OutlineEdge> walls;
  double low = 0, high = 0;  ///< z of the caps
  double scale = 1, scale_slope = 0;
  double least_scale = 1, most_scale = 1;  ///< over the box; positive
  Vec2 place;                              ///< of the outline's plane
  bool is_inside = false;
};

}  // namespace tenon
