#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/bounded_root.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// Where a quadratic is at most zero: nowhere, everywhere, from one root to the other, or up to one and from the other.
struct QuadraticSet {
  enum class Shape { none, all, between, outside };

  Shape shape = Shape::none;
  BoundedRoot first;  ///< first.t <= second.t; -inf for a root that has gone to infinity
  BoundedRoot second;
};

/// Solves q(t) = a t² + 2 b t + c <= 0 for a polynomial q that is known to within `error`.
///
/// Let q* be the exact polynomial, |q* - q| <= error wherever it matters. Then {q <= -error} ⊆ {q* <= 0} ⊆ {q <=
/// error}, and with D = b² - a c the roots of q ± error are (-b ± sqrt(D ∓ a error)) / a. Two cases follow:
///
///   D >  |a| error   both inner and outer set have both roots, at most error / sqrt(D) away from those of q;
///   D <= |a| error   the inner set has none: the exact roots, if any, lie anywhere in the outer set, a cluster around
///                    -b / a. When even the outer set has none (D < -|a| error) there are no exact roots.
///
/// A pair of roots is therefore reported if and only if the outer set has one, a cluster without real roots of q as a
/// double root. **What this promises for coincident surfaces** (two computed versions of one exact surface, each with
/// an error bound of its own): if the exact surface has the pair, every version reports it, and the intervals contain
/// the exact roots; if it does not, then the intervals of a pair that some version reports meet each other, for each
/// contains its whole outer set. So a chord that only one version sees is one whose two ends count as one.
///
/// Roots follow from the larger one, without cancellation: a may vanish, and the root that it sends to infinity is
/// ±inf.
///
/// @param error  >= 0; must include the rounding of the formula itself, gamma(8) (|a| t² + 2 |b t| + |c|) at the roots:
///               the computed ones are those of a polynomial whose coefficients differ by as much, relatively (D takes
///               gamma(3), which sqrt halves, the sum and the divisions one each)
inline QuadraticSet solve_quadratic(double a, double b, double c, double error) {
  using Shape = QuadraticSet::Shape;
  if (a == 0 && b == 0) return {c <= error ? Shape::all : Shape::none, {}, {}};

  const bool opens_up = a >= 0;
  const Shape shape = opens_up ? Shape::between : Shape::outside;
  const double discriminant = b * b - a * c;
  const double slack = std::fabs(a) * error;
  if (!(discriminant >= -slack)) return {opens_up ? Shape::none : Shape::all, {}, {}};

  if (discriminant <= slack) {
    // a = 0 does not come here: then slack = 0 < b² = discriminant (or b² underflows, and the vertex is infinite).
    const double vertex = -b / a;
    const double half = std::sqrt(std::max(discriminant, 0.0)) / std::fabs(a);
    const double outer = std::sqrt(std::max(discriminant + slack, 0.0)) / std::fabs(a);
    return {shape, {vertex - half, vertex - outer, vertex + outer}, {vertex + half, vertex - outer, vertex + outer}};
  }

  const double root = std::sqrt(discriminant);
  const double sum = b >= 0 ? -(b + root) : root - b;
  const double infinity = std::numeric_limits<double>::infinity();
  const double far = a != 0 ? sum / a : std::copysign(infinity, sum);
  const double near = c / sum;
  const double bound = error / root;
  const double t1 = std::min(far, near), t2 = std::max(far, near);
  return {shape, {t1, t1 - bound, t1 + bound}, {t2, t2 - bound, t2 + bound}};
}

/// The other root of a t² + 2 b t, whose root at 0 has been divided out: -2 b / a.
///
/// @param a_error, b_error  bounds on the errors of a and b
/// @return the root, with an interval that reaches to infinity where a may be zero
inline BoundedRoot solve_deflated(double a, double b, double a_error, double b_error) {
  const double infinity = std::numeric_limits<double>::infinity();
  // A root at infinity lies on the side where a parabola that opens upward has it.
  const double t = a != 0 ? -2 * b / a : std::copysign(infinity, -b);
  const double least = std::fabs(a) - a_error;
  if (least > 0) {
    const double bound = (a_error * std::fabs(t) + 2 * b_error) / least;
    return {t, t - bound, t + bound};
  }
  // Neither coefficient has a certain sign: the root may be anywhere.
  if (!(std::fabs(b) > b_error)) return {t, -infinity, infinity};
  // The exact root is at least this far away, on this side or beyond infinity on the other.
  const double nearest = 2 * (std::fabs(b) - b_error) / (std::fabs(a) + a_error);
  return t >= 0 ? BoundedRoot{t, std::min(nearest, t), infinity} : BoundedRoot{t, -infinity, std::max(-nearest, t)};
}

}  // namespace tenon
