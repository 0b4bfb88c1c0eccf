// Lines and triangles of a mesh: whether they cross, and where. Included once for each instruction set.

#if defined(TENON_PRIMITIVE_MESH_CANDIDATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_PRIMITIVE_MESH_CANDIDATE_INL_H_
#undef TENON_PRIMITIVE_MESH_CANDIDATE_INL_H_
#else
#define TENON_PRIMITIVE_MESH_CANDIDATE_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <type_traits>
#include <utility>

#include "math/lane_numbers-inl.h"
#include "tenon/math/rounding.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

/// The number that a line has of each of its figures: a double, or LaneNumbers where it stands for several.
template <class Line>
using NumberOf = std::remove_cvref_t<decltype(std::declval<Line>().along_error)>;

/// Twice the area that an edge makes with a line, and a bound on how far it is from the exact line's.
template <class Number>
struct EdgeArea {
  Number value, error;

  HWY_INLINE auto is_positive() const { return value > error; }
  HWY_INLINE auto is_negative() const { return value < -error; }
};

/// A triangle as a line sees it: the areas of its edges, each opposite to a corner.
template <class Number>
struct SeenTriangle {
  using Condition = decltype(Number() < Number());

  Condition is_missed;   ///< no line within the errors crosses it; where that holds of all, nothing else is said
  Condition is_certain;  ///< they all do
  Condition positive;    ///< some edge certainly runs around the line, counterclockwise as it comes
  EdgeArea<Number> areas[3];
};

template <class Number>
HWY_INLINE EdgeArea<Number> FindArea(Number ax, Number ay, Number bx, Number by, const Number (&e)[2]) {
  // Each coordinate is within e; e exceeds four roundings of the coordinates, so twice the first order covers the
  // roundings of the products as well, once the product of two errors is added.
  const Number error =
      2.0 * ((magnitude(ax) + magnitude(bx)) * e[1] + (magnitude(ay) + magnitude(by)) * e[0] + 2.0 * e[0] * e[1]);
  return {ax * by - ay * bx, error};
}

/// The triangle with corners at some places across the line.
/// @param error  how far they may be from there
template <class Number>
HWY_INLINE SeenTriangle<Number> SeeCorners(const Number (&x)[3], const Number (&y)[3], const Number (&error)[2]) {
  using Condition = typename SeenTriangle<Number>::Condition;
  const auto is_beside = [](const Number(&place)[3], Number most) HWY_ATTR {
    return (smaller(smaller(place[0], place[1]), place[2]) > most) |
           (larger(larger(place[0], place[1]), place[2]) < -most);
  };
  SeenTriangle<Number> seen;
  seen.is_missed = is_beside(x, error[0]) | is_beside(y, error[1]);
  seen.is_certain = seen.positive = seen.is_missed;
  if (are_all(seen.is_missed)) return seen;
  const EdgeArea<Number> u = FindArea(x[1], y[1], x[2], y[2], error);
  const EdgeArea<Number> v = FindArea(x[2], y[2], x[0], y[0], error);
  const EdgeArea<Number> w = FindArea(x[0], y[0], x[1], y[1], error);
  const Condition negative = u.is_negative() | v.is_negative() | w.is_negative();
  const Condition all_negative = u.is_negative() & v.is_negative() & w.is_negative();
  const Condition all_positive = u.is_positive() & v.is_positive() & w.is_positive();
  seen.positive = u.is_positive() | v.is_positive() | w.is_positive();
  seen.is_missed = seen.is_missed | (seen.positive & negative);
  seen.is_certain = all_positive | all_negative;
  seen.areas[0] = u;
  seen.areas[1] = v;
  seen.areas[2] = w;
  return seen;
}

template <class Line>
HWY_INLINE SeenTriangle<NumberOf<Line>> SeeTriangle(const Line& line, const std::array<Vec3, 3>& p) {
  using Number = NumberOf<Line>;
  Number x[3], y[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const Number height = p[i][line.along] - line.origin[line.along];
    x[i] = (p[i][line.across[0]] - line.origin[line.across[0]]) - line.shear[0] * height;
    y[i] = (p[i][line.across[1]] - line.origin[line.across[1]]) - line.shear[1] * height;
  }
  return SeeCorners(x, y, line.shear_error);
}

/// Where a line crosses the triangle's plane: the quotient's interval, within the part of the line beside the triangle.
template <class Number>
struct TrianglePlace {
  Number t;       ///< of the line, not yet scaled
  Number lo, hi;  ///< contain the exact crossing, if there is one
};

template <class Line>
HWY_INLINE TrianglePlace<NumberOf<Line>> FindPlace(const Line& line, const std::array<Vec3, 3>& p,
                                                   const EdgeArea<NumberOf<Line>> (&areas)[3]) {
  using Number = NumberOf<Line>;
  const auto t_of = [&line](const Vec3& corner) HWY_ATTR {
    return (corner[line.along] - line.origin[line.along]) / line.direction[line.along];
  };
  const Number ta = t_of(p[0]), tb = t_of(p[1]), tc = t_of(p[2]);
  const auto& [u, v, w] = areas;
  Number lo = smaller(smaller(ta, tb), tc), hi = larger(larger(ta, tb), tc);
  // First by weights, then corrected by the plane through the triangle, seen from there: so the triangle's own shape
  // counts, and not how far away the origin lies.
  const Number sum = u.value + v.value + w.value, middle = 0.5 * lo + 0.5 * hi;
  Number t = (u.value * ta + v.value * tb + w.value * tc) / sum;
  const typename SeenTriangle<Number>::Condition is_number = (t == t) & !(sum == 0.0);
  t = choose(is_number, smaller(larger(t, lo), hi), middle);
  lo = lo - line.along_error;
  hi = hi + line.along_error;

  const Vec3 along_b = p[1] - p[0], along_c = p[2] - p[0];
  const Vec3 n = cross(along_b, along_c);
  const Vec3 mb = abs(along_b), mc = abs(along_c);
  const Vec3 n_error = gamma(5) * Vec3{mb.y * mc.z + mb.z * mc.y, mb.z * mc.x + mb.x * mc.z, mb.x * mc.y + mb.y * mc.x};
  const auto from_a = (line.origin + t * line.direction) - p[0];
  const auto here_error = line.origin_error + magnitude(t) * line.direction_error +
                          gamma(3) * (abs(line.origin) + magnitude(t) * abs(line.direction) + abs(p[0]));
  const Number value = dot(n, from_a), slope = dot(n, line.direction);
  const Number value_error =
      dot(abs(n), here_error) + dot(n_error, abs(from_a) + here_error) + gamma(4) * dot(abs(n), abs(from_a));
  const Number slope_error = dot(abs(n), line.direction_error) + dot(n_error, abs(line.direction)) +
                             gamma(4) * dot(abs(n), abs(line.direction));
  const Number least = magnitude(slope) - slope_error;
  const Number move = -value / slope;
  // |value* / slope* - value / slope| <= (value_error + |move| slope_error) / least
  const Number error = ((value_error + magnitude(move) * slope_error) / least) * (1 + gamma(8)) +
                       gamma(4) * (magnitude(move) + magnitude(t));
  const Number place = t + move;
  const auto is_known = least > 0.0;
  lo = choose(is_known, larger(lo, place - error), lo);
  hi = choose(is_known, smaller(hi, place + error), hi);
  t = choose(is_known, place, t);
  // An exact line that passes the triangle by leaves no common part; then any place beside it will do.
  const auto in_order = lo <= hi;
  const Number first = choose(in_order, lo, hi), last = choose(in_order, hi, lo);
  return {smaller(larger(t, first), last), first, last};
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#endif
