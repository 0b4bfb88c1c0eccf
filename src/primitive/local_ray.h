#pragma once

#include <limits>

#include "tenon/math/vec3.h"

namespace tenon {

/// A ray in a primitive's local frame, with what is known about its error.
///
/// The origin has been moved along the ray to near the primitive (the caller adds the shift to every t), so that the
/// coefficients of a polynomial in t do not cancel. The exact line of the scene passes, at every t, within
/// `origin_error + |t| * direction_error` of `origin + t * direction`, component by component.
struct LocalRay {
  Vec3 origin;
  Vec3 direction;
  Vec3 origin_error;
  Vec3 direction_error;
  /// The face the ray starts on, or -1. The crossing with this face at t = 0 is known to be exactly there: it is
  /// reported with t = 0 and bound 0, and the other roots are those of the polynomial divided by t.
  int on_face = -1;
};

/// The part of a line that is asked about.
struct LineWindow {
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();

  bool meets(double from, double to) const { return from <= end && to >= begin; }
};

}  // namespace tenon
