#pragma once

#include <algorithm>
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

/// x² + y² <= r² between z = 0 and z = h, or between -h/2 and h/2.
struct Cylinder {
  double h = 1;
  double r = 1;
  bool center = false;

  static constexpr std::string_view name = "cylinder", scad_name = "cylinder";
  static constexpr std::string_view doc = "A round cylinder around z.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 1.6;
  static constexpr auto fields() {
    return std::tuple{Field{"h", Unit::length, &Cylinder::h, "height"},
                      Field{"r", Unit::length, &Cylinder::r, "radius"},
                      Field{"center", Unit::none, &Cylinder::center, "around z = 0 instead of above it"}};
  }
  enum Face : std::uint32_t { side, bottom, top };

  std::string check() const { return check_lengths(name, {{"h", h}, {"r", r}}); }

  double low() const { return center ? -0.5 * h : 0; }
  double high() const { return center ? 0.5 * h : h; }

  double support(const Vec3& n) const {
    return r * std::sqrt(n.x * n.x + n.y * n.y) + std::max(n.z * low(), n.z * high());
  }

  void spans(const LocalRay& ray, Spans& out) const {
    Chord chord;
    if (!clip_slab(ray, 2, low(), high(), bottom, top, chord)) return;
    if (clip_side(ray, chord)) emit_chord(chord, out);
  }

  Region classify(const LocalBox& box) const {
    if (box.bounds.upper.z < low() || box.bounds.lower.z > high()) return Region::outside;
    const bool between_caps = box.bounds.lower.z >= low() && box.bounds.upper.z <= high();
    if (between_caps && greatest_square(box, {1, 1, 0}) <= r * r) return Region::inside;
    if (is_separated(box, gradient_at_least({1, 1, 0}, {}, box), *this)) return Region::outside;
    return is_separated_by_box_faces(box, *this) ? Region::outside : Region::straddles;
  }

  std::uint32_t face_count() const { return 3; }
  Vec3 normal(const Vec3& point, std::uint32_t face) const {
    return face == side ? Vec3{point.x, point.y, 0} : Vec3{0, 0, face == top ? 1.0 : -1.0};
  }

 private:
  // As for the sphere, in the plane across the axis.
  bool clip_side(const LocalRay& ray, Chord& chord) const {
    const Vec3 o{ray.origin.x, ray.origin.y, 0}, d{ray.direction.x, ray.direction.y, 0};
    const Vec3 o_error{ray.origin_error.x, ray.origin_error.y, 0};
    const Vec3 d_error{ray.direction_error.x, ray.direction_error.y, 0};
    const double a = dot(d, d);
    const double between_caps = std::max(std::fabs(chord.enter.lo), std::fabs(chord.leave.hi));

    if (ray.on_face == side) return clip_side_from_it(o, d, o_error, d_error, chord);

    // Along the axis: a line that moves across less than its own error between the caps is inside or outside as a
    // whole.
    const double drift = std::sqrt(a) * between_caps;
    const double slip = length(o_error + between_caps * d_error);
    if (drift <= slip) {
      const double e = drift + slip;
      return dot(o, o) - r * r <= e * (2 * r + e) + gamma(6) * r * r;
    }

    const double nearest = -dot(o, d) / a;
    const Vec3 p = o + nearest * d;
    const double reach = std::min(between_caps, std::fabs(nearest) + 2 * r / std::sqrt(a));
    const double e = length(o_error + reach * d_error + gamma(1) * (std::fabs(nearest) * abs(d) + abs(p)));
    const double error = e * (2 * r + e) + gamma(12) * r * r;
    const QuadraticSet set = solve_quadratic(a, dot(p, d), dot(p, p) - r * r, error);
    if (set.shape != QuadraticSet::Shape::between) return set.shape == QuadraticSet::Shape::all;
    chord.enter = later(chord.enter, lateral_end(set.first, nearest, side));
    chord.leave = earlier(chord.leave, lateral_end(set.second, nearest, side));
    return true;
  }

  bool clip_side_from_it(const Vec3& o, const Vec3& d, const Vec3& o_error, const Vec3& d_error, Chord& chord) const {
    const double a = dot(d, d), b = dot(o, d);
    if (!(a > 0)) return true;
    const double a_error = dot(2 * abs(d) + d_error, d_error) + gamma(4) * a;
    const double b_error = dot(abs(o) + o_error, d_error) + dot(abs(d), o_error) + gamma(4) * dot(abs(o), abs(d));
    const End other = lateral_end(solve_deflated(a, b, a_error, b_error), 0, side);
    const End here{{}, side, true};
    chord.enter = later(chord.enter, b <= 0 ? here : other);
    chord.leave = earlier(chord.leave, b <= 0 ? other : here);
    return true;
  }
};

}  // namespace tenon
