#pragma once

#include <vector>

namespace tenon {

/// A corner of an outline, and the way from it to the next one.
struct OutlineCorner {
  double x = 0;
  double y = 0;
  /// 0 for a straight segment; else the tangent of a quarter of the angle of a circular arc, positive where it turns to
  /// the left (as in DXF polylines): 1 makes a half circle.
  double bulge = 0;

  friend constexpr bool operator==(const OutlineCorner&, const OutlineCorner&) = default;
};

/// Closed loops of segments and arcs in the plane. A point is inside when a way from it to infinity crosses them an odd
/// number of times: so loops may be holes, and may be given in any sense and order.
struct Outline {
  std::vector<std::vector<OutlineCorner>> loops;

  friend bool operator==(const Outline&, const Outline&) = default;
};

}  // namespace tenon
