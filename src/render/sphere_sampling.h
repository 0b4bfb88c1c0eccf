#pragma once

#include <cmath>

#include "math/quarter_turns.h"
#include "render/sampler.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// An orthonormal frame around a direction.
struct Frame {
  Vec3 s, t, n;

  /// @param n  length 1
  explicit Frame(const Vec3& normal) : n(normal) {
    // Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
    const double sign = std::copysign(1.0, n.z);
    const double a = -1 / (sign + n.z), b = n.x * n.y * a;
    s = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    t = {b, sign + n.y * n.y * a, -n.y};
  }

  Vec3 to_world(const Vec3& v) const { return v.x * s + v.y * t + v.z * n; }
  Vec3 to_local(const Vec3& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
};

/// A direction of the upper hemisphere (z > 0) with density cos / pi, by Malley's method.
inline Vec3 cosine_hemisphere(const Sample2& sample) {
  const double radius = std::sqrt(sample.u);
  const SineCosine angle = quarter_turn_sine_cosine(4 * sample.v);
  return {radius * angle.cosine, radius * angle.sine, std::sqrt(1 - sample.u)};
}

}  // namespace tenon
