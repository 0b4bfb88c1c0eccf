#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "math/polynomial.h"
#include "primitive/local_ray.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// The torus along a line, as a quartic in s, the line being p0 + s d:
///
///   f(s) = w(s)² + z(s)² - r²,   w(s) = (|p(s)|² - R² - r²) / (2 R) = w0 + w1 s + w2 s².
///
/// This is the usual (|p|² + R² - r²)² - 4 R² (x² + y²), divided by 4 R², with R² taken out of the square: in the usual
/// form terms of size R² cancel, here |w| <= r and |z| <= r on the surface, so that a thin ring loses nothing. It is
/// kept as the two functions w and z; expanded, it would cancel again.
class TorusQuartic {
 public:
  /// @param moved  the line is expanded at this t
  /// @param scale  t = moved + scale * s, with |s| <= 1 where f matters
  TorusQuartic(double R, double r, const LocalRay& ray, double moved, double scale) : r_square_(r * r) {
    const Vec3 p = ray.origin + moved * ray.direction, d = scale * ray.direction;
    w0_ = (dot(p, p) - (R * R + r * r)) / (2 * R);
    w1_ = dot(p, d) / R;
    w2_ = dot(d, d) / (2 * R);
    z0_ = p.z;
    z1_ = d.z;

    // The place on the line is wrong by e: what the ray brings along, and the rounding of p. Then the distance to the
    // circle is wrong by e, its square by 2 r e + e² on the surface, and f = (square of the distance - r²) times
    // ((ρ + R)² + z² - r²) / (4 R²), a factor of at most 1 + (r + e) / R there.
    const double farthest = std::fabs(moved) + scale;
    place_error_ =
        ray.origin_error + farthest * ray.direction_error + gamma(1) * (std::fabs(moved) * abs(ray.direction) + abs(p));
    direction_error_ = scale * ray.direction_error;
    const double e = length(place_error_);
    input_error_ = e * (2 * r + e) * (1 + (r + e) / R);
    // Roundings of w: six in w0, up to three more for each step of evaluating it.
    const Vec3 p_size = abs(p), d_size = abs(d);
    w_rounding_ = gamma(8) * ((dot(p, p) + R * R + r * r) / (2 * R) + dot(p_size, d_size) / R + w2_);
    w0_error_ = w_rounding_ + dot(p_size + place_error_, place_error_) / R;
    w1_error_ = (dot(p_size + place_error_, direction_error_) + dot(d_size, place_error_)) / R +
                gamma(5) * dot(p_size, d_size) / R;
    w2_error_ = dot(d_size + direction_error_, direction_error_) / R + gamma(5) * w2_;
  }

  double value(double s) const {
    const double w = w_at(s), z = z0_ + z1_ * s;
    return w * w + z * z - r_square_;
  }
  double slope(double s) const { return 2 * (w_at(s) * (w1_ + 2 * w2_ * s) + (z0_ + z1_ * s) * z1_); }
  double half_curvature(double s) const {
    const double w_slope = w1_ + 2 * w2_ * s;
    return w_slope * w_slope + 2 * w2_ * w_at(s) + z1_ * z1_;
  }
  double error(double s) const {
    const double w = std::fabs(w_at(s)), z = z0_ + z1_ * s;
    return input_error_ + (2 * w + w_rounding_) * w_rounding_ + gamma(5) * (w * w + z * z + r_square_);
  }
  Polynomial<3> derivative() const {
    return {{2 * (w0_ * w1_ + z0_ * z1_), 2 * (w1_ * w1_ + 2 * w0_ * w2_ + z1_ * z1_), 6 * w1_ * w2_, 4 * w2_ * w2_}};
  }

 private:
  friend class DeflatedTorusQuartic;

  double w_at(double s) const { return (w2_ * s + w1_) * s + w0_; }

  double w0_ = 0, w1_ = 0, w2_ = 0, z0_ = 0, z1_ = 0;
  double r_square_ = 0;
  double input_error_ = 0, w_rounding_ = 0;
  double w0_error_ = 0, w1_error_ = 0, w2_error_ = 0;
  Vec3 place_error_, direction_error_;
};

/// A root of TorusQuartic that comes out the same, to the last bit, from whatever place near it the search begins: by
/// Newton's method from the multiple of a step that is nearest to that place, on the quartic expanded there. So whoever
/// knows a root roughly, and not too near to the middle between two multiples, finds the double that spans() reports.
struct SettledTorusRoot {
  static constexpr int newton_steps = 5;
  /// Against the radius of the tube over |direction|, of which the largest power of two no greater counts.
  static constexpr double relative_step = 0x1p-6;
  /// Against the step: how far Newton's last step may go.
  static constexpr double relative_rest = 0x1p-30;
  /// Against 2 r |direction|, which is the slope of a line through the middle of the tube.
  static constexpr double relative_slope = 0x1p-7;

  double t = 0;
  double step = 0;
  bool settled = false;  ///< the method came to rest, at a root that is no double one
  bool rising = false;

  SettledTorusRoot(double R, double r, const LocalRay& ray, double near) {
    const Vec3& d = ray.direction;
    const double square = dot(d, d), speed = std::sqrt(square);
    step = power_of_two_below(r / speed) * relative_step;
    const double from = std::nearbyint(near * (1 / step)) * step;
    const Vec3 p = ray.origin + from * d;
    const double w0 = (dot(p, p) - (R * R + r * r)) / (2 * R), w1 = dot(p, d) / R, w2 = square / (2 * R);
    const double z0 = p.z, z1 = d.z;
    double s = 0, last = 0, slope = 0;
    for (int i = 0; i < newton_steps; ++i) {
      const double w = (w2 * s + w1) * s + w0, z = z0 + z1 * s;
      slope = 2 * (w * (w1 + 2 * w2 * s) + z * z1);
      last = (w * w + z * z - r * r) / slope;
      s = s - last;
    }
    t = from + s;
    rising = slope > 0;
    settled = std::fabs(last) <= step * relative_rest && std::fabs(s) <= step &&
              std::fabs(slope) >= 2 * relative_slope * (r * speed);
  }

 private:
  static double power_of_two_below(double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000);
  }
};

/// The same for a line that is known to lie on the torus at s = 0: the constant term is zero, and s is divided out.
///
///   g(s) = f(s) / s = (w1 + w2 s) (2 w0 + w1 s + w2 s²) + z1 (2 z0 + z1 s)
class DeflatedTorusQuartic {
 public:
  explicit DeflatedTorusQuartic(const TorusQuartic& quartic) : f_(quartic) {
    const auto& q = quartic;
    g_.c = {2 * (q.w0_ * q.w1_ + q.z0_ * q.z1_), q.w1_ * q.w1_ + 2 * q.w0_ * q.w2_ + q.z1_ * q.z1_, 2 * q.w1_ * q.w2_,
            q.w2_ * q.w2_};
    first_ = g_.derivative();
    second_ = first_.derivative();

    // Errors of the coefficients, product by product; second-order terms are below the roundings counted with them.
    const double w0 = std::fabs(q.w0_), w1 = std::fabs(q.w1_), w2 = q.w2_;
    const double z0 = std::fabs(q.z0_), z1 = std::fabs(q.z1_);
    const double w0e = q.w0_error_, w1e = q.w1_error_, w2e = q.w2_error_;
    const double z0e = q.place_error_.z, z1e = q.direction_error_.z;
    error_.c = {2 * ((w0 + w0e) * w1e + w1 * w0e + (z0 + z0e) * z1e + z1 * z0e) + gamma(6) * 2 * (w0 * w1 + z0 * z1),
                (2 * w1 + w1e) * w1e + 2 * ((w0 + w0e) * w2e + w2 * w0e) + (2 * z1 + z1e) * z1e +
                    gamma(6) * (w1 * w1 + 2 * w0 * w2 + z1 * z1),
                2 * ((w1 + w1e) * w2e + w2 * w1e) + gamma(6) * 2 * w1 * w2, (2 * w2 + w2e) * w2e + gamma(6) * w2 * w2};
  }

  double value(double s) const { return g_.value(s); }
  double slope(double s) const { return first_.value(s); }
  double half_curvature(double s) const { return 0.5 * second_.value(s); }
  /// The lesser of two bounds: by the coefficients, which holds near the start, and by the undivided quartic, which is
  /// better away from it (f(0), known to be zero, shows how far the two differ).
  double error(double s) const {
    const double t = std::fabs(s);
    const double rounding = gamma(7) * g_.size(s);
    return std::min(error_.value(t), (f_.error(s) + std::fabs(f_.value(0))) / t) + rounding;
  }
  Polynomial<2> derivative() const { return first_; }

 private:
  TorusQuartic f_;
  Polynomial<3> g_;
  Polynomial<2> first_;
  Polynomial<1> second_;
  Polynomial<3> error_;
};

}  // namespace tenon
