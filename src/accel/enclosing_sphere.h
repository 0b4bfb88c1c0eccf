#pragma once

#include "tenon/math/box3.h"
#include "tenon/math/ray.h"

namespace tenon {

/// RR-612's spherical enclosure (§3.3), which filters the rays that do not come from the eye.
struct EnclosingSphere {
  Vec3 center;
  double radius_squared = 0;

  EnclosingSphere() = default;
  /// Around a box, grown by `margin`, which covers the rounding of missed_by(): 2^-51 of the distance of the origin.
  EnclosingSphere(const Box3& box, double margin) : center(box.center()) {
    const double radius = length(box.size()) / 2 + margin;
    radius_squared = radius * radius;
  }

  /// Whether the ray's line passes outside. The distance is taken from the cross product, not as a difference of
  /// squares, which would cancel for an origin far away.
  bool missed_by(const Ray& ray) const {
    const Vec3 n = cross(center - ray.origin, ray.direction);
    return dot(n, n) > radius_squared * dot(ray.direction, ray.direction);
  }
};

}  // namespace tenon
