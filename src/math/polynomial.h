#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "math/bounded_root.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// A polynomial of degree at most N, lowest coefficient first.
template <int N>
struct Polynomial {
  static_assert(N >= 0);
  static constexpr std::size_t count = static_cast<std::size_t>(N) + 1;

  std::array<double, count> c{};

  constexpr double value(double t) const {
    double v = c[count - 1];
    for (std::size_t i = count - 1; i-- > 0;) v = v * t + c[i];
    return v;
  }
  /// Sum of |c_i t^i|: gamma(2N) times it bounds the rounding of value() (Higham, section 5.1).
  constexpr double size(double t) const {
    const double s = t < 0 ? -t : t;
    double v = 0;
    for (std::size_t i = count; i-- > 0;) v = v * s + (c[i] < 0 ? -c[i] : c[i]);
    return v;
  }
  constexpr auto derivative() const {
    Polynomial<(N > 0 ? N - 1 : 0)> d;
    for (std::size_t i = 1; i < count; ++i) d.c[i - 1] = static_cast<double>(i) * c[i];
    return d;
  }
};

/// A list of at most `Capacity` things, without allocation.
template <class T, int Capacity>
class ShortList {
 public:
  void push_back(const T& item) { items_[size_++] = item; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  const T* begin() const { return items_.data(); }
  const T* end() const { return items_.data() + size_; }

 private:
  std::array<T, static_cast<std::size_t>(Capacity)> items_;
  std::size_t size_ = 0;
};

/// Newton's next guess for a zero of f near t.
struct NewtonStep {
  template <class F>
  double operator()(const F& f, double t, double value) const {
    return t - value / f.slope(t);
  }
};

/// The place between a and b where f changes its sign, to the last bit of the larger end: by an iterative method, kept
/// inside the bracket by bisection, and given up for bisection alone where it converges slowly (multiple roots).
///
/// @param f      has value(t), and what the method asks for
/// @param value_a, value_b  of opposite sense: exactly one of them is < 0
/// @param next_guess  the method: the next guess, from f, the last one and the value there
template <class F, class Step = NewtonStep>
double find_sign_change(const F& f, double a, double b, double value_a, double value_b, Step next_guess = {}) {
  const bool rising = value_a < 0;
  const double last_bit = unit_roundoff * std::max(std::fabs(a), std::fabs(b));
  // Newton doubles the number of right bits with each step: 53 = 2^6 bits, and as many steps to get near.
  constexpr int newton_steps = 12;
  double t = a - value_a * ((b - a) / (value_b - value_a));
  for (int step = 0; b - a > last_bit; ++step) {
    if (!(t > a && t < b)) {
      t = 0.5 * a + 0.5 * b;
      if (!(t > a && t < b)) return t;
    }
    const double value = f.value(t);
    if (value == 0) return t;
    ((value < 0) == rising ? a : b) = t;
    const double next = next_guess(f, t, value);
    if (std::fabs(next - t) <= last_bit) return t;
    t = step < newton_steps ? next : 0.5 * a + 0.5 * b;
  }
  return t > a && t < b ? t : 0.5 * a + 0.5 * b;
}

template <int N>
struct PolynomialFunction {
  Polynomial<N> p;
  Polynomial<(N > 0 ? N - 1 : 0)> derivative = p.derivative();

  double value(double t) const { return p.value(t); }
  double slope(double t) const { return derivative.value(t); }
};

/// Where a polynomial changes its sign between a and b, sorted; for splitting a higher one into monotone pieces. By
/// recursion: the sign changes of the derivative split it into pieces that have at most one each.
template <int N>
ShortList<double, (N > 0 ? N : 1)> sign_changes(const Polynomial<N>& p, double a, double b) {
  ShortList<double, (N > 0 ? N : 1)> roots;
  if constexpr (N == 1) {
    const double t = -p.c[0] / p.c[1];
    if (t > a && t < b) roots.push_back(t);
  } else if constexpr (N == 2) {
    const double half = 0.5 * p.c[1], discriminant = half * half - p.c[2] * p.c[0];
    if (!(discriminant > 0)) return roots;
    const double sum = half >= 0 ? -(half + std::sqrt(discriminant)) : std::sqrt(discriminant) - half;
    const double t1 = sum / p.c[2], t2 = p.c[0] / sum;
    if (std::min(t1, t2) > a && std::min(t1, t2) < b) roots.push_back(std::min(t1, t2));
    if (std::max(t1, t2) > a && std::max(t1, t2) < b) roots.push_back(std::max(t1, t2));
  } else if constexpr (N > 2) {
    const PolynomialFunction<N> f{p};
    const auto turns = sign_changes(f.derivative, a, b);
    double from = a, value_from = p.value(a);
    const auto look_until = [&](double to) {
      const double value_to = p.value(to);
      if ((value_from < 0) != (value_to < 0)) roots.push_back(find_sign_change(f, from, to, value_from, value_to));
      from = to;
      value_from = value_to;
    };
    for (const double turn : turns) look_until(turn);
    look_until(b);
  }
  return roots;
}

/// A root of a function known to within an error, and which way the function crosses zero there.
struct CrossingRoot : BoundedRoot {
  bool rising = false;
};

/// The nearest place beyond t, in one direction, where the sign of f is certain (|f| > error) and, up to the next
/// turning point, the expected one: t itself may be off the zero of f by its last bit.
///
/// @param distance  where to look first; it is doubled until the place is found
/// @param limit     no further than here
/// @param splits    turning points of f
template <class F>
double find_certain_place(const F& f, double t, double distance, double direction, double limit, bool negative,
                          std::span<const double> splits) {
  for (;;) {
    const double at = t + direction * distance;
    if (!((limit - at) * direction > 0)) return limit;
    // The turning points are the most certain places around; do not step over one.
    bool passed_turn = false;
    for (const double split : splits) {
      const bool between = direction > 0 ? split > t && split < at : split < t && split > at;
      if (between && std::fabs(f.value(split)) > f.error(split)) return split;
      passed_turn = passed_turn || between;
    }
    const double value = f.value(at);
    if (std::fabs(value) > f.error(at) && (passed_turn || (value < 0) == negative)) return at;
    distance *= 2;
  }
}

/// How far from a root at t the sign of f should be certain, by its slope and its curvature there.
/// @param span  of the interval that is searched
template <class F>
double distance_to_certainty(const F& f, double t, double span) {
  // The errors double to make the first place certain: f grows by slope * distance, or by its curvature.
  const double error = 2 * f.error(t);
  const double by_slope = error / std::fabs(f.slope(t));
  const double by_curvature = std::sqrt(error / std::fabs(f.half_curvature(t)));
  const double distance = std::min(by_slope, by_curvature);
  const double least = 2 * unit_roundoff * std::max(std::fabs(t), unit_roundoff * span);
  return distance > least && std::isfinite(distance) ? distance : least;
}

/// All real roots between two places of a function f that is known to within an error.
///
/// @param f       has value(t), slope(t), half_curvature(t) (half the second derivative) and error(t), which bounds
///                |f* - f| at t for the exact function f*, rounding included
/// @param splits  increasing: the first and last are the ends; between two neighbours f is monotone
/// @param roots   appended to, sorted
///
/// Wherever |f| > error, the sign of f* is certain. A root's interval reaches to the nearest certain places on both
/// sides, so that it holds the exact root; in a cluster too narrow for any certain place between its roots, all their
/// intervals hold the whole cluster. A turning point that misses zero by less than its error counts as a double root,
/// as in solve_quadratic, and for the reason given there; so the number of roots has the parity that the signs of f at
/// the two ends ask for.
template <class F, int Capacity>
void find_bounded_roots(const F& f, std::span<const double> splits, ShortList<CrossingRoot, Capacity>& roots) {
  const double begin = splits.front(), end = splits.back();
  // The signs are those of f before and behind.
  const auto interval_around = [&](double t, bool negative_before, bool negative_behind) {
    const double distance = distance_to_certainty(f, t, end - begin);
    CrossingRoot root;
    root.t = t;
    root.lo = find_certain_place(f, t, distance, -1, begin, negative_before, splits);
    root.hi = find_certain_place(f, t, distance, 1, end, negative_behind, splits);
    root.rising = negative_before;
    return root;
  };

  double value = f.value(splits[0]);
  for (std::size_t i = 0; i + 1 < splits.size(); ++i) {
    const double next = f.value(splits[i + 1]);
    if ((value < 0) != (next < 0)) {
      const double t = find_sign_change(f, splits[i], splits[i + 1], value, next);
      roots.push_back(interval_around(t, value < 0, value >= 0));
    }
    // A turning point is itself known only as well as the slope vanishes there.
    if (i + 2 < splits.size()) {
      const double turn = splits[i + 1], slope = std::fabs(f.slope(turn));
      const double shift = std::min(slope / std::fabs(f.half_curvature(turn)), end - begin);
      const bool alone = (value < 0) == (next < 0) && (f.value(splits[i + 2]) < 0) == (next < 0);
      if (alone && std::fabs(next) <= f.error(turn) + slope * shift) {
        CrossingRoot root = interval_around(turn, next < 0, next < 0);
        roots.push_back(root);
        root.rising = !root.rising;
        roots.push_back(root);
      }
    }
    value = next;
  }
}

/// A polynomial whose coefficients are known to within errors, as find_bounded_roots wants it.
template <int N>
struct BoundedPolynomial {
  Polynomial<N> p;
  Polynomial<N> coefficient_error;  ///< >= 0
  Polynomial<(N > 0 ? N - 1 : 0)> first = p.derivative();
  Polynomial<(N > 1 ? N - 2 : 0)> second = first.derivative();

  double value(double t) const { return p.value(t); }
  double slope(double t) const { return first.value(t); }
  double half_curvature(double t) const { return 0.5 * second.value(t); }
  double error(double t) const { return coefficient_error.value(std::fabs(t)) + gamma(2 * N + 1) * p.size(t); }
};

/// All real roots of a polynomial between a and b, clusters included: find_bounded_roots says what is promised.
template <int N>
ShortList<CrossingRoot, 2 * N> solve_polynomial(const BoundedPolynomial<N>& f, double a, double b) {
  static_assert(N >= 1);
  std::array<double, static_cast<std::size_t>(N) + 1> splits;
  std::size_t count = 0;
  splits[count++] = a;
  for (const double turn : sign_changes(f.first, a, b)) splits[count++] = turn;
  splits[count++] = b;
  ShortList<CrossingRoot, 2 * N> roots;
  find_bounded_roots(f, std::span<const double>(splits.data(), count), roots);
  return roots;
}

}  // namespace tenon
