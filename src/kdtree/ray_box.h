#pragma once

#include <limits>

#include "tenon/math/box3.h"
#include "tenon/math/ray.h"

namespace tenon {

/// A ray prepared for many tests against boxes along the axes (course, "Intersection test: parallelepiped").
struct BoxRay {
  Vec3 origin;
  Vec3 inverse;  ///< 1 / direction, component by component; ±inf where the ray is parallel to the face

  explicit BoxRay(const Ray& ray)
      : origin(ray.origin), inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z} {}
};

/// The stretch of a ray inside a box; empty when t_in > t_out.
struct BoxSpan {
  double t_in;
  double t_out;
  bool empty() const { return t_in > t_out; }
};

/// Where the ray, from `t_min` to `t_max`, lies in the box. Each end errs by a few units in the last place of t and of
/// the ray's origin, which a margin of the boxes has to cover.
inline BoxSpan clip(const BoxRay& ray, const Box3& box, double t_min = 0,
                    double t_max = std::numeric_limits<double>::infinity()) {
  for (int axis = 0; axis < 3; ++axis) {
    const double inv = ray.inverse[axis];
    double near = (box.lower[axis] - ray.origin[axis]) * inv;
    double far = (box.upper[axis] - ray.origin[axis]) * inv;
    if (inv < 0) std::swap(near, far);
    // 0 * inf, an origin in the face of a slab it is parallel to, is NaN and must not narrow the stretch: the
    // comparisons are false for it.
    if (near > t_min) t_min = near;
    if (far < t_max) t_max = far;
  }
  return {t_min, t_max};
}

}  // namespace tenon
