#pragma once

#include <cmath>

#include "math/vec2.h"

namespace tenon {

struct Circle {
  Vec2 center;
  double radius = 0;
};

/// The circle of an arc given by its ends and its bulge (OutlineCorner), which is not 0.
inline Circle circle_of_arc(const Vec2& from, const Vec2& to, double bulge) {
  const Vec2 w = to - from;
  const double to_center = (1 - bulge) * (1 + bulge) / (4 * bulge);
  return {0.5 * (from + to) + to_center * Vec2{-w.y, w.x}, length(w) * (1 + bulge * bulge) / (4 * std::fabs(bulge))};
}

/// The point in the middle of an arc; of a segment where the bulge is 0.
inline Vec2 middle_of_arc(const Vec2& from, const Vec2& to, double bulge) {
  const Vec2 w = to - from;
  return 0.5 * (from + to) + 0.5 * bulge * Vec2{w.y, -w.x};
}

}  // namespace tenon
