#pragma once

#include <array>
#include <optional>

#include "tenon/math/vec3.h"

namespace tenon {

/// The affine map p -> L p + b as three rows (L | b). Named by what it does, right to left: `world_from_local`.
struct Affine3 {
  std::array<std::array<double, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  friend constexpr bool operator==(const Affine3&, const Affine3&) = default;

  constexpr Vec3 point(const Vec3& p) const { return direction(p) + translation(); }
  constexpr Vec3 direction(const Vec3& v) const { return {dot(row(0), v), dot(row(1), v), dot(row(2), v)}; }
  /// L^T v: how normals are carried when this is the inverse map, and how support directions are.
  constexpr Vec3 transposed_direction(const Vec3& v) const { return row(0) * v.x + row(1) * v.y + row(2) * v.z; }
  constexpr Vec3 row(int i) const {
    const auto& r = m[static_cast<std::size_t>(i)];
    return {r[0], r[1], r[2]};
  }
  constexpr Vec3 column(int j) const {
    const auto k = static_cast<std::size_t>(j);
    return {m[0][k], m[1][k], m[2][k]};
  }
  constexpr Vec3 translation() const { return {m[0][3], m[1][3], m[2][3]}; }

  constexpr double determinant() const { return dot(row(0), cross(row(1), row(2))); }
  /// The inverse map, or nothing when the map flattens space (or is not finite).
  std::optional<Affine3> inverse() const;

  static constexpr Affine3 translate(const Vec3& v) { return {{{{1, 0, 0, v.x}, {0, 1, 0, v.y}, {0, 0, 1, v.z}}}}; }
  static constexpr Affine3 scale(const Vec3& s) { return {{{{s.x, 0, 0, 0}, {0, s.y, 0, 0}, {0, 0, s.z, 0}}}}; }
  /// Around x, then y, then z, by angles in degrees, as OpenSCAD's `rotate([x, y, z])`.
  static Affine3 rotate(const Vec3& degrees);
  /// Around `axis` by an angle in degrees, right-handed; the identity for a zero axis.
  static Affine3 rotate(double degrees, const Vec3& axis);
  /// Mirror in the plane through the origin with this normal; the identity for a zero normal.
  static Affine3 mirror(const Vec3& normal);
};

/// First `b`, then `a`.
constexpr Affine3 operator*(const Affine3& a, const Affine3& b) {
  Affine3 c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j] + (j == 3 ? a.m[i][3] : 0);
    }
  }
  return c;
}

/// Sine and cosine of an angle in degrees; exact at multiples of 90 (and sin at 30, cos at 60), and the nearest doubles
/// at multiples of 30 and 45.
double sin_degrees(double degrees);
double cos_degrees(double degrees);

}  // namespace tenon
