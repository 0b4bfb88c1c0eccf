#pragma once

#include "tenon/math/vec3.h"

namespace tenon {

/// The half-line p(t) = origin + t * direction, t >= 0. The direction need not have length 1.
struct Ray {
  Vec3 origin;
  Vec3 direction;

  constexpr Vec3 at(double t) const { return origin + t * direction; }
};

}  // namespace tenon
