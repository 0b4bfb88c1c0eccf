#pragma once

#include <numbers>
#include <vector>

#include "primitive/arc.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// From one direction to the other, in radians, positive to the left.
inline double angle_between(const Vec2& a, const Vec2& b) {
  return std::atan2(cross(a, b), dot(a, b));
}

inline Vec2 turned_by(const Vec2& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

/// The points of an arc by the share of its angle, from 0 to 1; at the ends exactly those.
/// @param bulge  not 0
inline auto arc_points(const Vec2& from, const Vec2& to, double bulge) {
  return [from, to, circle = circle_of_arc(from, to, bulge), angle = 4 * std::atan(bulge)](double share) {
    return share == 0 ? from : share == 1 ? to : circle.center + turned_by(from - circle.center, share * angle);
  };
}

/// Adds the corner that an arc begins with: two where it is more than a half circle.
/// @param angle  that it turns by, in radians, positive to the left
inline void add_arc(const Vec2& center, const Vec2& from, double angle, std::vector<OutlineCorner>& loop) {
  if (std::fabs(angle) <= std::numbers::pi) {
    loop.push_back({from.x, from.y, std::tan(angle / 4)});
    return;
  }
  const Vec2 middle = center + turned_by(from - center, angle / 2);
  const double half = std::tan(angle / 8);
  loop.push_back({from.x, from.y, half});
  loop.push_back({middle.x, middle.y, half});
}

/// A circle as two arcs, to the left where `bulge` is 1, to the right where it is -1.
inline std::vector<OutlineCorner> full_circle(const Circle& circle, double bulge) {
  const Vec2& c = circle.center;
  return {{c.x, c.y - circle.radius, bulge}, {c.x, c.y + circle.radius, bulge}};
}

}  // namespace tenon
