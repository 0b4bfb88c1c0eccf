#pragma once

#include <algorithm>
#include <cmath>

#include "math/quarter_turns.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// A number known to lie within `radius` of `middle` (midpoint-radius arithmetic: Rump, "Verification methods", 2010).
/// Every operation adds its own rounding to the radius.
struct Ball {
  double middle = 0, radius = 0;

  double least() const { return middle - radius; }
  double greatest() const { return middle + radius; }
  bool is_positive() const { return middle > radius; }
  bool is_negative() const { return middle < -radius; }
  bool has_sign() const { return std::fabs(middle) > radius; }

  // The last factor covers the roundings of the radius itself.
  static Ball rounded(double middle, double radius) {
    return {middle, (radius + unit_roundoff * std::fabs(middle)) * (1 + gamma(8))};
  }
  friend Ball operator+(const Ball& a, const Ball& b) { return rounded(a.middle + b.middle, a.radius + b.radius); }
  friend Ball operator-(const Ball& a, const Ball& b) { return rounded(a.middle - b.middle, a.radius + b.radius); }
  friend Ball operator*(const Ball& a, const Ball& b) {
    return rounded(a.middle * b.middle,
                   std::fabs(a.middle) * b.radius + std::fabs(b.middle) * a.radius + a.radius * b.radius);
  }
  friend Ball operator*(double a, const Ball& b) { return rounded(a * b.middle, std::fabs(a) * b.radius); }
};

/// The arithmetic of balls, by the names of EnclosureArithmetic: of a function's values alone.
struct BallArithmetic {
  using Number = Ball;

  static Ball constant(const Ball& value) { return value; }
  static Ball add(const Ball& a, const Ball& b) { return a + b; }
  static Ball subtract(const Ball& a, const Ball& b) { return a - b; }
  static Ball multiply(const Ball& a, const Ball& b) { return a * b; }
  static Ball multiply(double a, const Ball& b) { return a * b; }
  /// Sine and cosine of an angle in quarter turns. Neither changes faster than the angle.
  static void sine_cosine(const Ball& q, Ball& sine, Ball& cosine) {
    const SineCosine value = quarter_turn_sine_cosine(q.middle);
    const double radius = std::min(half_pi * q.radius * (1 + gamma(4)) + sine_cosine_error, 2.0);
    sine = {value.sine, radius};
    cosine = {value.cosine, radius};
  }
};

/// A function's value and its derivative at one place, as they are computed (a dual number).
struct Dual {
  double value = 0, slope = 0;
};

/// The arithmetic of dual numbers, by the names of EnclosureArithmetic.
struct DualArithmetic {
  using Number = Dual;

  static Dual constant(const Ball& value) { return {value.middle, 0}; }
  static Dual add(const Dual& a, const Dual& b) { return {a.value + b.value, a.slope + b.slope}; }
  static Dual subtract(const Dual& a, const Dual& b) { return {a.value - b.value, a.slope - b.slope}; }
  static Dual multiply(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.slope * b.value + a.value * b.slope};
  }
  static Dual multiply(double a, const Dual& b) { return {a * b.value, a * b.slope}; }
  static Dual multiply(const Ball& a, const Dual& b) { return multiply(a.middle, b); }
  static void sine_cosine(const Dual& q, Dual& sine, Dual& cosine) {
    const SineCosine value = quarter_turn_sine_cosine(q.value);
    const double turn = half_pi * q.slope;
    sine = {value.sine, value.cosine * turn};
    cosine = {value.cosine, -value.sine * turn};
  }
};

/// What is known of a smooth function of t over an interval: its value and its derivative in the middle, its second
/// derivative anywhere, and so by Taylor's theorem its values and its derivative anywhere.
struct Enclosure {
  Ball middle, middle_slope, curvature;
  Ball range, slope;

  static Enclosure of(const Ball& middle, const Ball& middle_slope, const Ball& curvature, double half_width) {
    const double bend = (std::fabs(curvature.middle) + curvature.radius) * half_width;
    const double rise = (std::fabs(middle_slope.middle) + middle_slope.radius + 0.5 * bend) * half_width;
    return {middle, middle_slope, curvature, Ball::rounded(middle.middle, middle.radius + rise),
            Ball::rounded(middle_slope.middle, middle_slope.radius + bend)};
  }
};

/// Arithmetic of enclosures over one interval.
class EnclosureArithmetic {
 public:
  using Number = Enclosure;

  explicit EnclosureArithmetic(double half_width) : half_width_(half_width) {}

  static Enclosure constant(const Ball& value) { return {value, {0, 0}, {0, 0}, value, {0, 0}}; }
  Enclosure add(const Enclosure& a, const Enclosure& b) const {
    return of(a.middle + b.middle, a.middle_slope + b.middle_slope, a.curvature + b.curvature);
  }
  Enclosure subtract(const Enclosure& a, const Enclosure& b) const {
    return of(a.middle - b.middle, a.middle_slope - b.middle_slope, a.curvature - b.curvature);
  }
  Enclosure multiply(const Enclosure& a, const Enclosure& b) const {
    return of(a.middle * b.middle, a.middle_slope * b.middle + a.middle * b.middle_slope,
              a.curvature * b.range + 2 * (a.slope * b.slope) + a.range * b.curvature);
  }
  Enclosure multiply(double a, const Enclosure& b) const {
    return of(a * b.middle, a * b.middle_slope, a * b.curvature);
  }
  Enclosure multiply(const Ball& a, const Enclosure& b) const {
    return of(a * b.middle, a * b.middle_slope, a * b.curvature);
  }
  /// Sine and cosine of an angle in quarter turns.
  void sine_cosine(const Enclosure& q, Enclosure& sine, Enclosure& cosine) const {
    Ball s, c, s_range, c_range;
    BallArithmetic::sine_cosine(q.middle, s, c);
    BallArithmetic::sine_cosine(q.range, s_range, c_range);
    const Ball quarter = Ball::rounded(half_pi, 0);
    const Ball turn = quarter * q.middle_slope, square = (quarter * q.slope) * (quarter * q.slope);
    const Ball bend = quarter * q.curvature, none{0, 0};
    sine = of(s, c * turn, c_range * bend - s_range * square);
    cosine = of(c, none - s * turn, none - (s_range * bend + c_range * square));
  }

 private:
  Enclosure of(const Ball& middle, const Ball& slope, const Ball& curvature) const {
    return Enclosure::of(middle, slope, curvature, half_width_);
  }

  double half_width_;
};

}  // namespace tenon
