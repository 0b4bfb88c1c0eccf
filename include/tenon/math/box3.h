#pragma once

#include <limits>

#include "tenon/math/vec3.h"

namespace tenon {

/// A closed box along the axes; empty when any lower end lies above its upper end. Ends may be infinite.
struct Box3 {
  static constexpr double inf = std::numeric_limits<double>::infinity();

  Vec3 lower{inf, inf, inf};
  Vec3 upper{-inf, -inf, -inf};

  static constexpr Box3 empty() { return {}; }
  static constexpr Box3 everything() { return {{-inf, -inf, -inf}, {inf, inf, inf}}; }

  friend constexpr bool operator==(const Box3&, const Box3&) = default;

  constexpr bool is_empty() const { return lower.x > upper.x || lower.y > upper.y || lower.z > upper.z; }
  /// True when every end is finite; false for the empty box, whose ends are infinite.
  bool is_bounded() const {
    return std::isfinite(lower.x) && std::isfinite(lower.y) && std::isfinite(lower.z) && std::isfinite(upper.x) &&
           std::isfinite(upper.y) && std::isfinite(upper.z);
  }
  constexpr bool contains(const Vec3& p) const {
    return lower.x <= p.x && p.x <= upper.x && lower.y <= p.y && p.y <= upper.y && lower.z <= p.z && p.z <= upper.z;
  }
  constexpr bool contains(const Box3& b) const { return b.is_empty() || (contains(b.lower) && contains(b.upper)); }
  constexpr bool overlaps(const Box3& b) const {
    return lower.x <= b.upper.x && b.lower.x <= upper.x && lower.y <= b.upper.y && b.lower.y <= upper.y &&
           lower.z <= b.upper.z && b.lower.z <= upper.z;
  }
  constexpr Vec3 center() const { return lower * 0.5 + upper * 0.5; }
  constexpr Vec3 size() const { return upper - lower; }
  /// Twice the half: 2(ab + bc + ca); 0 for the empty box.
  constexpr double surface_area() const {
    if (is_empty()) return 0;
    const Vec3 s = size();
    return 2 * (s.x * s.y + s.y * s.z + s.z * s.x);
  }
  /// The largest absolute coordinate.
  double largest_coordinate() const { return is_empty() ? 0 : max_component(max(abs(lower), abs(upper))); }
};

/// The smallest box around both (the hull).
constexpr Box3 hull(const Box3& a, const Box3& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return {min(a.lower, b.lower), max(a.upper, b.upper)};
}
constexpr Box3 hull(const Box3& a, const Vec3& p) {
  return hull(a, Box3{p, p});
}
/// What both share; Box3::empty() when that is nothing.
constexpr Box3 intersection(const Box3& a, const Box3& b) {
  const Box3 c{max(a.lower, b.lower), min(a.upper, b.upper)};
  return c.is_empty() ? Box3::empty() : c;
}
/// The box grown by `margin` on every side.
constexpr Box3 grown(const Box3& a, double margin) {
  if (a.is_empty()) return a;
  const Vec3 m{margin, margin, margin};
  return {a.lower - m, a.upper + m};
}

}  // namespace tenon
