#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <tuple>

#include "math/quadratic.h"
#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/clip.h"
#include "primitive/concept.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// x² + y² + z² <= r².
struct Sphere {
  double r = 1;

  static constexpr std::string_view name = "sphere", scad_name = "sphere";
  static constexpr std::string_view doc = "A ball around the origin.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 1;
  static constexpr auto fields() { return std::tuple{Field{"r", Unit::length, &Sphere::r, "radius"}}; }

  std::string check() const { return check_lengths(name, {{"r", r}}); }

  double support(const Vec3& n) const { return r * length(n); }

  void spans(const LocalRay& ray, Spans& out) const {
    const Vec3& d = ray.direction;
    const double a = dot(d, d);
    if (!(a > 0)) return;
    if (ray.on_face >= 0) {
      emit_chord(chord_from_surface(ray, a), out);
      return;
    }
    // Expand at the point nearest to the centre, where the constant term has the least to cancel.
    const double nearest = -dot(ray.origin, d) / a;
    const Vec3 p = ray.origin + nearest * d;
    const double b = dot(p, d), c = dot(p, p) - r * r;
    const QuadraticSet set = solve_quadratic(a, b, c, error(ray, nearest, p, a));
    if (set.shape != QuadraticSet::Shape::between) return;
    emit_chord({lateral_end(set.first, nearest, 0), lateral_end(set.second, nearest, 0)}, out);
  }

  Region classify(const LocalBox& box) const {
    if (greatest_square(box, {1, 1, 1}) <= r * r) return Region::inside;
    return is_separated(box, gradient_at_least({1, 1, 1}, {}, box), *this) ? Region::outside : Region::straddles;
  }

  std::uint32_t face_count() const { return 1; }
  Vec3 normal(const Vec3& point, std::uint32_t) const { return point; }

 private:
  // Bound on |q* - q| near the roots, q(t) = |p(t)|² - r². An exact crossing lies within e of its computed place, which
  // is therefore at a distance r ± e from the centre, so q is off by at most 2 r e + e². It happens within 2 r / |d| of
  // the nearest point, as long as the errors are small against the sphere (e < r / 2, direction error < |d| / 4).
  // The rest is rounding: five in |p|², two in r², ten in the solution for a t², and |p|² + a t² = r².
  double error(const LocalRay& ray, double nearest, const Vec3& p, double a) const {
    const double reach = std::fabs(nearest) + 2 * r / std::sqrt(a);
    const Vec3 place =
        ray.origin_error + reach * ray.direction_error + gamma(1) * (std::fabs(nearest) * abs(ray.direction) + abs(p));
    const double e = length(place);
    return e * (2 * r + e) + gamma(12) * r * r;
  }

  Chord chord_from_surface(const LocalRay& ray, double a) const {
    const Vec3 o = abs(ray.origin), d = abs(ray.direction);
    const Vec3 &oe = ray.origin_error, &de = ray.direction_error;
    const double b = dot(ray.origin, ray.direction);
    const double a_error = 2 * dot(d, de) + dot(de, de) + gamma(4) * a;
    const double b_error = dot(o, de) + dot(d, oe) + dot(oe, de) + gamma(4) * dot(o, d);
    const End here{{}, 0, true}, other = lateral_end(solve_deflated(a, b, a_error, b_error), 0, 0);
    return b <= 0 ? Chord{here, other} : Chord{other, here};
  }
};

}  // namespace tenon
