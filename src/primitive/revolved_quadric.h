#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/quadratic.h"
#include "primitive/box_tests.h"
#include "primitive/clip.h"
#include "primitive/local_ray.h"
#include "primitive/polish_root.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// A quadric of revolution around z between two caps: q(p) <= 0 and low <= z <= high, with
///
///   q(p) = x² + y² - w(z)² - linear z - constant,   w(z) = offset + slope z.
///
/// A cone has w alone, a hyperboloid of one sheet w and the constant, a paraboloid the linear term alone.
struct RevolvedQuadric {
  double offset = 0, slope = 0, linear = 0, constant = 0;
  double low = 0, high = 0;
  double greatest_radius = 0;  ///< of the surface between the caps

  enum Face : std::uint32_t { side, bottom, top };

  void spans(const LocalRay& ray, Spans& out) const;

  /// Bounds of q over a box, right to first order in the box's size.
  Extent range(const LocalBox& box) const;

  Vec3 gradient(const Vec3& p) const { return {2 * p.x, 2 * p.y, -2 * (offset + slope * p.z) * slope - linear}; }

  /// q along the line, expanded at t: q(t + s) = a s² + 2 b s + c, and what the terms were before they cancelled.
  struct Expansion {
    double a, b, c;
    double a_size, b_size, c_size;
    Vec3 place;         ///< the line at t
    double w, w_slope;  ///< w there, and along the line
    Vec3 place_error;   ///< bound on the error of the place within `reach` of t = 0
    double w_error;     ///< and of w
  };
  Expansion expand(const LocalRay& ray, double t, double reach) const;
  /// Bound on |q* - q| within `away` of the expansion point.
  double error_at(const Expansion& e, double away) const;
  /// Whether a root at the expansion point is not moved any more (polish_root), so that it can be found in a vector, by
  /// solve() alone. Of a cone the slope of q falls with the radius, and what it errs by in the whole window does not:
  /// from a 64th of the greatest radius on a root is at most 64 times as far off as on the rim. Towards the tip it
  /// gains more.
  bool is_settled(const Expansion& e) const {
    return e.place.x * e.place.x + e.place.y * e.place.y > settled_square * (greatest_radius * greatest_radius);
  }
  static constexpr double settled_square = 0x1p-12;

 private:
  // The part of a line that matters, and the place on it at which q is expanded.
  struct Window {
    double begin = 0, end = 0;
    double at = 0;
  };
  bool find_window(const LocalRay& ray, const Chord& chord, Window& window) const;
  QuadraticSet solve(const LocalRay& ray, const Window& window) const;
  QuadraticSet solve_from_surface(const LocalRay& ray) const;
};

inline RevolvedQuadric::Expansion RevolvedQuadric::expand(const LocalRay& ray, double t, double reach) const {
  const Vec3& d = ray.direction;
  Expansion e;
  e.place = ray.origin + t * d;
  const Vec3& p = e.place;
  e.w = offset + slope * p.z;
  e.w_slope = slope * d.z;
  e.a_size = d.x * d.x + d.y * d.y;
  const double b_across = p.x * d.x + p.y * d.y;
  const double c_across = p.x * p.x + p.y * p.y;
  const double w_square = e.w_slope * e.w_slope;
  e.a = e.a_size - w_square;
  e.b = b_across - e.w * e.w_slope - 0.5 * linear * d.z;
  e.c = c_across - e.w * e.w - linear * p.z - constant;
  e.a_size += w_square;
  e.b_size = std::fabs(p.x * d.x) + std::fabs(p.y * d.y) + std::fabs(e.w * e.w_slope) + std::fabs(linear * d.z);
  e.c_size = c_across + e.w * e.w + std::fabs(linear * p.z) + constant;
  // The product and the sum round once each.
  e.place_error = ray.origin_error + reach * ray.direction_error + gamma(1) * (std::fabs(t) * abs(d) + abs(p));
  // offset and slope were themselves rounded, three times at most.
  e.w_error = std::fabs(slope) * e.place_error.z + gamma(5) * (std::fabs(offset) + std::fabs(slope * p.z));
  return e;
}

// Each square u² is off by 2 |u| e + e², the linear term by its own, and the coefficients by the rounding of their sums
// (and that of linear and constant, at most six).
inline double RevolvedQuadric::error_at(const Expansion& e, double away) const {
  const double rounding = e.c_size + away * (2 * e.b_size + away * e.a_size);
  const double across = 2 * std::sqrt(e.c_size + away * (2 * e.b_size + away * e.a_size));
  const double place = std::sqrt(e.place_error.x * e.place_error.x + e.place_error.y * e.place_error.y);
  return (across + place) * place + (across + e.w_error) * e.w_error + std::fabs(linear) * e.place_error.z +
         gamma(10) * rounding;
}

// Where the line is near enough to matter: between the caps, and inside a cylinder around the whole side. There no term
// of q exceeds the square of the greatest radius by much, so expanding at the place nearest to the axis between the
// caps, which does not depend on the errors, loses nothing.
inline bool RevolvedQuadric::find_window(const LocalRay& ray, const Chord& chord, Window& window) const {
  const Vec3 &o = ray.origin, &d = ray.direction;
  const double a = d.x * d.x + d.y * d.y;
  const double nearest = -(o.x * d.x + o.y * d.y) / a;
  const double x = o.x + nearest * d.x, y = o.y + nearest * d.y;
  // The margin only has to exceed all errors; whatever lies in it is judged by q.
  const double slip =
      ray.origin_error.x + ray.origin_error.y + std::fabs(nearest) * (ray.direction_error.x + ray.direction_error.y);
  const double radius = greatest_radius * 1.0625 + slip;
  const double square = radius * radius - (x * x + y * y);
  if (square < 0) return false;
  const double half = std::sqrt(square / a);
  window.begin = chord.enter.lo;
  window.end = chord.leave.hi;
  // A line along the axis has no nearest point, or none that can be computed.
  if (std::isfinite(half) && std::isfinite(nearest)) {
    window.begin = std::max(window.begin, nearest - half);
    window.end = std::min(window.end, nearest + half);
  }
  const double not_before = nearest > chord.enter.t ? nearest : chord.enter.t;
  window.at = not_before > chord.leave.t ? chord.leave.t : not_before;
  return window.begin <= window.end && std::isfinite(window.begin) && std::isfinite(window.end);
}

// Two roots too near to be told apart are solved again around their own place, as long as that narrows them down: at
// the tip of a cone, where all terms vanish, a cluster of width sqrt(u) shrinks to u.
inline QuadraticSet RevolvedQuadric::solve(const LocalRay& ray, const Window& window) const {
  // A little beyond the window, so that a cluster at its very end (a tip) lies within.
  double at = window.at, away = 1.0625 * std::max(window.end - at, at - window.begin);
  for (;;) {
    const Expansion e = expand(ray, at, std::max(std::fabs(at - away), std::fabs(at + away)));
    QuadraticSet set = solve_quadratic(e.a, e.b, e.c, error_at(e, away));
    const double middle = 0.5 * (set.first.lo + set.second.hi), half = 0.5 * (set.second.hi - set.first.lo);
    const bool clustered = half > 0 && set.first.hi >= set.second.lo;
    if (!clustered || !(half < 0.5 * away) || !(std::fabs(middle) + half <= away)) {
      for (BoundedRoot* root : {&set.first, &set.second})
        *root = lateral_end(*root, at, side);  // NOLINT(cppcoreguidelines-slicing): the face is set apart
      return set;
    }
    at += middle;
    away = half * (1 + gamma(4)) + gamma(2) * std::fabs(at);
  }
}

inline QuadraticSet RevolvedQuadric::solve_from_surface(const LocalRay& ray) const {
  using Shape = QuadraticSet::Shape;
  const Vec3 d_error = ray.direction_error;
  const Expansion e = expand(ray, 0, 0);
  if (e.a == 0 && e.b == 0) return {Shape::all, {}, {}};
  const double slope_error = std::fabs(slope) * d_error.z;
  const Vec3 d = abs(ray.direction), p = abs(e.place);
  const double w = std::fabs(e.w), w_slope = std::fabs(e.w_slope);
  const double a_error = (2 * d.x + d_error.x) * d_error.x + (2 * d.y + d_error.y) * d_error.y +
                         (2 * w_slope + slope_error) * slope_error + gamma(12) * e.a_size;
  const Vec3& p_error = e.place_error;
  const double b_error = (p.x + p_error.x) * d_error.x + d.x * p_error.x + (p.y + p_error.y) * d_error.y +
                         d.y * p_error.y + (w + e.w_error) * slope_error + w_slope * e.w_error +
                         0.5 * std::fabs(linear) * d_error.z + gamma(10) * e.b_size;
  const BoundedRoot here, other = solve_deflated(e.a, e.b, a_error, b_error);
  const Shape shape = e.a >= 0 ? Shape::between : Shape::outside;
  return other.t >= 0 ? QuadraticSet{shape, here, other} : QuadraticSet{shape, other, here};
}

inline void RevolvedQuadric::spans(const LocalRay& ray, Spans& out) const {
  using Shape = QuadraticSet::Shape;
  Chord slab;
  if (!clip_slab(ray, 2, low, high, bottom, top, slab)) return;
  Window window;
  if (!find_window(ray, slab, window)) return;

  const bool from_side = ray.on_face == side;
  QuadraticSet set = from_side ? solve_from_surface(ray) : solve(ray, window);
  if (set.shape == Shape::none) return;
  if (set.shape == Shape::all) {
    emit_chord(slab, out);
    return;
  }
  for (BoundedRoot* root : {&set.first, &set.second}) {
    if (root->lo <= window.end && root->hi >= window.begin) polish_root(*this, ray, *root);
  }
  // Of the two roots of a ray that starts on the side, one is the start.
  const auto end_of = [from_side](const BoundedRoot& root) {
    return End{root, side, from_side && root.t == 0 && root.lo == 0 && root.hi == 0};
  };
  const End first = end_of(set.first), second = end_of(set.second);
  if (set.shape == Shape::between) {
    emit_chord({later(slab.enter, first), earlier(slab.leave, second)}, out);
  } else {
    emit_chords({slab.enter, earlier(slab.leave, first)}, {later(slab.enter, second), slab.leave}, out);
  }
}

// q(c + δ) = q(c) + ∇q·δ + δx² + δy² - slope² δz², with δ = Σ a_j h_j, |a_j| <= 1.
inline Extent RevolvedQuadric::range(const LocalBox& box) const {
  const Vec3& c = box.center;
  const double w = offset + slope * c.z;
  const Vec3 g = gradient(c);
  double first_order = dot(abs(g), box.error);
  double across = box.error.x + box.error.y, along = box.error.z;
  for (const Vec3& h : box.half_edges) {
    first_order += std::fabs(dot(g, h));
    across += std::sqrt(h.x * h.x + h.y * h.y);
    along += std::fabs(h.z);
  }
  const double upward = across * across, downward = slope * slope * along * along;
  const Vec3 m = reach(box);
  const double w_size = std::fabs(offset) + std::fabs(slope) * m.z;
  // No term is larger than these, and none takes more than sixteen roundings.
  const double rounding =
      gamma(16) * 4 * (m.x * m.x + m.y * m.y + w_size * w_size + std::fabs(linear) * m.z + constant);
  const double least = c.x * c.x + c.y * c.y - w * w - linear * c.z - constant - first_order - downward - rounding;
  const double greatest = least + 2 * first_order + upward + downward + 2 * rounding;
  return {0.5 * (least + greatest), 0.5 * (greatest - least) * (1 + gamma(4)) + rounding};
}

}  // namespace tenon
