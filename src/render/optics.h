#pragma once

#include <cmath>
#include <optional>

#include "tenon/math/vec3.h"

namespace tenon {

/// The mirrored direction.
/// @param d  where the light goes, length 1
/// @param n  the surface's normal against d, length 1
inline Vec3 reflect(const Vec3& d, const Vec3& n) {
  return normalize(d - 2 * dot(d, n) * n);
}

/// The direction behind the surface by Snell's law; none under total internal reflection.
/// @param d    where the light goes, length 1
/// @param n    the surface's normal against d, length 1
/// @param eta  index of refraction before the surface over that behind it
inline std::optional<Vec3> refract(const Vec3& d, const Vec3& n, double eta) {
  if (eta == 1) return d;
  const double cos_in = -dot(d, n);
  const double cos_out_squared = 1 - eta * eta * (1 - cos_in * cos_in);
  if (cos_out_squared < 0) return std::nullopt;
  return normalize(eta * d + (eta * cos_in - std::sqrt(cos_out_squared)) * n);
}

}  // namespace tenon
