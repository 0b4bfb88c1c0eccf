#pragma once

#include <algorithm>
#include <cmath>

namespace tenon {

/// A vector or a point of the plane.
struct Vec2 {
  double x = 0;
  double y = 0;

  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
  friend constexpr Vec2 operator+(const Vec2& a, const Vec2& b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Vec2 operator*(double s, const Vec2& a) { return {s * a.x, s * a.y}; }
};

constexpr double dot(const Vec2& a, const Vec2& b) {
  return a.x * b.x + a.y * b.y;
}
/// Twice the area of the triangle 0, a, b; positive when b lies to the left of a.
constexpr double cross(const Vec2& a, const Vec2& b) {
  return a.x * b.y - a.y * b.x;
}
inline Vec2 abs(const Vec2& a) {
  return {std::fabs(a.x), std::fabs(a.y)};
}
constexpr Vec2 min(const Vec2& a, const Vec2& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y)};
}
constexpr Vec2 max(const Vec2& a, const Vec2& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y)};
}
inline double length(const Vec2& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace tenon
