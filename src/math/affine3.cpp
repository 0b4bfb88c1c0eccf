#include "tenon/math/affine3.h"

#include <cmath>
#include <numbers>

namespace tenon {

namespace {

// Sine of an angle in [0, 90] degrees.
double sin_first_quadrant(double degrees) {
  if (degrees == 30) return 0.5;
  if (degrees == 45) return std::numbers::sqrt2 / 2;
  if (degrees == 60) return std::numbers::sqrt3 / 2;
  if (degrees == 90) return 1;
  if (degrees > 45) return std::cos((90 - degrees) * (std::numbers::pi / 180));
  return std::sin(degrees * (std::numbers::pi / 180));
}

}  // namespace

// fmod and the reflections are exact; only the last step rounds.
double sin_degrees(double degrees) {
  double a = std::fmod(std::fabs(degrees), 360.0);
  const bool negative = (a > 180) != (degrees < 0);
  if (a > 180) a -= 180;
  if (a > 90) a = 180 - a;
  const double s = sin_first_quadrant(a);
  return negative && s != 0 ? -s : s;
}

double cos_degrees(double degrees) {
  double a = std::fmod(std::fabs(degrees), 360.0);
  if (a > 180) a = 360 - a;
  return a <= 90 ? sin_first_quadrant(90 - a) : -sin_first_quadrant(a - 90);
}

Affine3 Affine3::rotate(const Vec3& degrees) {
  const double sx = sin_degrees(degrees.x), cx = cos_degrees(degrees.x);
  const double sy = sin_degrees(degrees.y), cy = cos_degrees(degrees.y);
  const double sz = sin_degrees(degrees.z), cz = cos_degrees(degrees.z);
  return {{{{cy * cz, cz * sx * sy - cx * sz, cx * cz * sy + sx * sz, 0},
            {cy * sz, cx * cz + sx * sy * sz, cx * sy * sz - cz * sx, 0},
            {-sy, cy * sx, cx * cy, 0}}}};
}

Affine3 Affine3::rotate(double degrees, const Vec3& axis) {
  if (axis == Vec3{}) return {};
  const Vec3 a = normalize(axis);
  const double s = sin_degrees(degrees), c = cos_degrees(degrees), k = 1 - c;
  return {{{{k * a.x * a.x + c, k * a.x * a.y - s * a.z, k * a.x * a.z + s * a.y, 0},
            {k * a.x * a.y + s * a.z, k * a.y * a.y + c, k * a.y * a.z - s * a.x, 0},
            {k * a.x * a.z - s * a.y, k * a.y * a.z + s * a.x, k * a.z * a.z + c, 0}}}};
}

// I - 2 n n^T / (n·n): without a normal of length 1, every entry takes one rounding less for each root and division.
Affine3 Affine3::mirror(const Vec3& normal) {
  const double scale = max_component(abs(normal));
  if (!(scale > 0) || !std::isfinite(scale)) return {};
  const Vec3 n = normal / std::ldexp(1.0, std::ilogb(scale));
  const Vec3 square = n * n;
  const double k = square.x + square.y + square.z;
  const double xy = -2 * n.x * n.y / k, xz = -2 * n.x * n.z / k, yz = -2 * n.y * n.z / k;
  return {{{{(square.y + square.z - square.x) / k, xy, xz, 0},
            {xy, (square.x + square.z - square.y) / k, yz, 0},
            {xz, yz, (square.x + square.y - square.z) / k, 0}}}};
}

std::optional<Affine3> Affine3::inverse() const {
  // Rows are scaled by powers of two first, so that the determinant neither overflows nor vanishes by its units alone.
  std::array<double, 3> scale{};
  std::array<Vec3, 3> r;
  for (int i = 0; i < 3; ++i) {
    const double largest = max_component(abs(row(i)));
    if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
    scale[static_cast<std::size_t>(i)] = std::ldexp(1.0, -std::ilogb(largest));
    r[static_cast<std::size_t>(i)] = row(i) * scale[static_cast<std::size_t>(i)];
  }
  // Adjugate over determinant: the columns of the inverse are cross products of the rows.
  const Vec3 c0 = cross(r[1], r[2]), c1 = cross(r[2], r[0]), c2 = cross(r[0], r[1]);
  const double det = dot(r[0], c0);
  if (!(std::fabs(det) > 0) || !std::isfinite(det)) return std::nullopt;
  Affine3 inv;
  for (int i = 0; i < 3; ++i) {
    auto& row_i = inv.m[static_cast<std::size_t>(i)];
    row_i[0] = c0[i] / det * scale[0];
    row_i[1] = c1[i] / det * scale[1];
    row_i[2] = c2[i] / det * scale[2];
  }
  const Vec3 b = inv.direction(translation());
  inv.m[0][3] = -b.x;
  inv.m[1][3] = -b.y;
  inv.m[2][3] = -b.z;
  for (const auto& row_i : inv.m) {
    for (double v : row_i) {
      if (!std::isfinite(v)) return std::nullopt;
    }
  }
  return inv;
}

}  // namespace tenon
