#pragma once

#include <cmath>
#include <cstddef>

#include "math/polynomial.h"

/// Methods that find_sign_change may refine a root of a BoundedPolynomial by (course, "Intersection with algebraic
/// surfaces"). Newton's is NewtonStep.
namespace tenon {

/// Laguerre's method: exact where all other roots are in one place.
template <int N>
struct LaguerreStep {
  double operator()(const BoundedPolynomial<N>& f, double t, double value) const {
    constexpr double n = N;
    const double slope = f.slope(t);
    const double square = (n - 1) * ((n - 1) * slope * slope - 2 * n * value * f.half_curvature(t));
    const double root = std::sqrt(square > 0 ? square : 0);
    return t - n * value / (slope < 0 ? slope - root : slope + root);
  }
};

/// Bairstow's method: a quadratic factor t² - r t - s is improved by Newton's method on the remainder of dividing by
/// it; the guess is that of its roots which lies nearer to the last one.
template <int N>
class BairstowStep {
 public:
  double operator()(const BoundedPolynomial<N>& f, double t, double) {
    static_assert(N >= 2);
    if (!started_) {
      // The factor's other root starts where the tangent of the polynomial without the first one would send it.
      const double other = t - f.slope(t) / f.half_curvature(t);
      r_ = t + other;
      s_ = -t * other;
      started_ = true;
    }
    // Twice the synthetic division; the last two of b are the remainder, those of c its derivatives.
    double b1 = 0, b2 = 0, c1 = 0, c2 = 0, c3 = 0;
    for (std::size_t i = f.p.count; i-- > 0;) {
      const double b = f.p.c[i] + r_ * b1 + s_ * b2;
      b2 = b1;
      b1 = b;
      if (i == 0) break;
      const double c = b + r_ * c1 + s_ * c2;
      c3 = c2;
      c2 = c1;
      c1 = c;
    }
    const double determinant = c2 * c2 - c3 * c1;
    r_ += (b1 * c3 - b2 * c2) / determinant;
    s_ += (b2 * c1 - b1 * c2) / determinant;
    const double half = 0.5 * r_, root = std::sqrt(half * half + s_);
    // The root of larger size without cancellation, the other by the product of both.
    const double larger = half < 0 ? half - root : half + root, smaller = -s_ / larger;
    return std::fabs(larger - t) < std::fabs(smaller - t) ? larger : smaller;
  }

 private:
  bool started_ = false;
  double r_ = 0, s_ = 0;
};

}  // namespace tenon
