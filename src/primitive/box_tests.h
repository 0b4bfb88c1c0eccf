#pragma once

#include <algorithm>
#include <cmath>

#include "primitive/local_box.h"
#include "tenon/math/rounding.h"
#include "tenon/math/vec3.h"

/// What several primitives ask of a LocalBox. Every answer errs towards "straddles": corners are taken with their
/// error, sums with their rounding.
namespace tenon {

/// The largest |coordinate| of the box per axis, error included.
inline Vec3 reach(const LocalBox& box) {
  return max(abs(box.bounds.lower), abs(box.bounds.upper));
}

/// n·p over the box lies within center ± radius.
struct Extent {
  double center = 0;
  double radius = 0;

  double least() const { return center - radius; }
  double greatest() const { return center + radius; }
};

inline Extent extent_along(const LocalBox& box, const Vec3& n) {
  const Vec3 m = abs(n);
  const double edges = std::fabs(dot(n, box.half_edges[0])) + std::fabs(dot(n, box.half_edges[1])) +
                       std::fabs(dot(n, box.half_edges[2]));
  // Three roundings a product sum, three more in adding four of them up.
  return {dot(n, box.center), edges + dot(m, box.error) + gamma(8) * dot(m, reach(box))};
}

/// Whether the plane n·p = solid.support(n) separates the box from the solid.
template <class Solid>
bool is_separated(const LocalBox& box, const Vec3& n, const Solid& solid) {
  const double support = solid.support(n);
  // A support takes at most eight roundings.
  return extent_along(box, n).least() > support + gamma(8) * std::fabs(support);
}

/// Whether the box's own faces separate it from the solid: the world's axes, as seen from the local frame.
template <class Solid>
bool is_separated_by_box_faces(const LocalBox& box, const Solid& solid) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 n = cross(box.half_edges[(i + 1) % 3], box.half_edges[(i + 2) % 3]);
    if (is_separated(box, n, solid) || is_separated(box, -n, solid)) return true;
  }
  return false;
}

/// The greatest sum of weight_i p_i² over the box, rounded up; weights >= 0. A convex function, so a corner has it.
inline double greatest_square(const LocalBox& box, const Vec3& weight) {
  double greatest = 0;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = abs(box.corner(i)) + box.error;
    greatest = std::max(greatest, dot(weight, corner * corner));
  }
  return greatest * (1 + gamma(10));
}

/// The gradient, at the point of the box where it is least, of the convex function
/// f(p) = sum of weight_i p_i² + 2 linear·p: the direction in which a plane separates the box from {f <= const}, if one
/// does. Found by descending along one edge after another (exact after one round for a box with right angles); whoever
/// uses it proves the separation.
inline Vec3 gradient_at_least(const Vec3& weight, const Vec3& linear, const LocalBox& box) {
  Vec3 p = box.center;
  double at[3] = {0, 0, 0};
  double curvature[3];
  for (std::size_t j = 0; j < 3; ++j) curvature[j] = dot(weight, box.half_edges[j] * box.half_edges[j]);
  for (int round = 0; round < 3; ++round) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec3& h = box.half_edges[j];
      const double slope = dot(weight * p + linear, h);
      double target = curvature[j] > 0 ? at[j] - slope / curvature[j] : std::copysign(1.0, -slope);
      target = std::clamp(target, -1.0, 1.0);
      p += (target - at[j]) * h;
      at[j] = target;
    }
  }
  return weight * p + linear;
}

}  // namespace tenon
