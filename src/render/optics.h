#pragma once

#include <algorithm>
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

/// The share of unpolarised light that a boundary of two dielectrics reflects (Fresnel).
/// @param cos_in  of the angle to the normal, before the boundary
/// @param eta     index of refraction before the boundary over that behind it
inline double fresnel_dielectric(double cos_in, double eta) {
  const double sin_squared = eta * eta * (1 - cos_in * cos_in);
  const double cos_out = std::sqrt(std::max(0.0, 1 - sin_squared));
  const double parallel = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
  const double perpendicular = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  return sin_squared >= 1 ? 1 : 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

/// What a conductor reflects (Schlick 1994), for one band.
/// @param f0  what it reflects straight on
inline double fresnel_schlick(double cos_in, double f0) {
  const double x = 1 - cos_in, x2 = x * x;
  return f0 + (1 - f0) * (x2 * x2 * x);
}

}  // namespace tenon
