#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/concept.h"
#include "primitive/torus_quartic.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// All points at most r away from the circle of radius R around z, r <= R.
struct Torus {
  double R = 1;
  double r = 0.25;

  static constexpr std::string_view name = "torus", scad_name = "torus";
  static constexpr std::string_view doc = "A ring around z at the origin.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 5.3;
  static constexpr auto fields() {
    return std::tuple{Field{"R", Unit::length, &Torus::R, "from the centre to the middle of the tube"},
                      Field{"r", Unit::length, &Torus::r, "radius of the tube, at most R"}};
  }

  std::string check() const {
    const std::string problem = check_lengths(name, {{"R", R}, {"r", r}});
    if (!problem.empty()) return problem;
    if (r > R) {
      return "torus with R = " + shortest(R) + " and r = " + shortest(r) +
             " runs into itself; keep r at most R, or use a sphere";
    }
    // A thinner tube has no bits left of its own in a coordinate of its ring.
    if (r < R * 0x1p-40) return "torus with r = " + shortest(r) + " is too thin for R = " + shortest(R);
    return {};
  }

  double support(const Vec3& n) const { return R * std::sqrt(n.x * n.x + n.y * n.y) + r * length(n); }

  void spans(const LocalRay& ray, Spans& out) const {
    double begin = 0, end = 0;
    if (!find_window(ray, begin, end)) return;
    ShortList<CrossingRoot, 8> roots;
    double moved = 0, scale = 0;
    if (ray.on_face >= 0) {
      scale = std::max(std::fabs(begin), std::fabs(end));
      const TorusQuartic quartic(R, r, ray, 0, scale);
      find_roots(DeflatedTorusQuartic(quartic), begin / scale, end / scale, roots);
    } else {
      moved = 0.5 * begin + 0.5 * end;
      scale = 0.5 * (end - begin);
      const TorusQuartic quartic(R, r, ray, moved, scale);
      find_roots(quartic, -1, 1, roots);
    }
    emit(ray, roots, moved, scale, out);
  }

  Region classify(const LocalBox& box) const;

  /// From the nearest point of the circle.
  std::uint32_t face_count() const { return 1; }
  Vec3 normal(const Vec3& point, std::uint32_t) const {
    const double across = std::sqrt(point.x * point.x + point.y * point.y);
    const double k = across > 0 ? 1 - R / across : 0;
    const Vec3 n{point.x * k, point.y * k, point.z};
    return n == Vec3{} ? Vec3{0, 0, 1} : n;
  }

 private:
  // The part of the line within a slab and a ball around the torus, both a sixteenth too large, so that its ends are
  // certainly outside the torus. False when there is none.
  bool find_window(const LocalRay& ray, double& begin, double& end) const {
    const Vec3 &o = ray.origin, &d = ray.direction;
    const double a = dot(d, d);
    const double nearest = -dot(o, d) / a;
    const Vec3 p = o + nearest * d;
    const Vec3 slip = ray.origin_error + std::fabs(nearest) * ray.direction_error;
    const double ball = (R + r) * 1.0625 + length(slip);
    const double square = ball * ball - dot(p, p);
    if (!(square > 0)) return false;
    const double half = std::sqrt(square / a);
    begin = nearest - half;
    end = nearest + half;
    const double slab = r * 1.0625 + slip.z + half * ray.direction_error.z;
    if (std::fabs(p.z) > slab + half * std::fabs(d.z)) return false;
    const double t1 = (-slab - o.z) / d.z, t2 = (slab - o.z) / d.z;
    if (std::isfinite(t1) && std::isfinite(t2)) {
      begin = std::max(begin, std::min(t1, t2));
      end = std::min(end, std::max(t1, t2));
    }
    if (ray.on_face >= 0) {
      begin = std::min(begin, 0.0);
      end = std::max(end, 0.0);
    }
    return begin < end && std::isfinite(begin) && std::isfinite(end);
  }

  template <class F>
  static void find_roots(const F& f, double begin, double end, ShortList<CrossingRoot, 8>& roots) {
    std::array<double, 5> splits;
    std::size_t count = 0;
    splits[count++] = begin;
    for (const double turn : sign_changes(f.derivative(), begin, end)) splits[count++] = turn;
    splits[count++] = end;
    find_bounded_roots(f, std::span<const double>(splits.data(), count), roots);
  }

  // The line comes from outside, so that crossings enter and leave in turn. The start of a ray on the surface is one
  // more crossing among the roots of the deflated quartic.
  void emit(const LocalRay& ray, const ShortList<CrossingRoot, 8>& roots, double moved, double scale,
            Spans& out) const {
    const bool from_surface = ray.on_face >= 0;
    if (roots.size() % 2 != (from_surface ? 1U : 0U)) return;
    bool entering = true;
    bool start_is_due = from_surface;
    const auto report = [&](const End& end) {
      const double bound = std::max({end.hi - end.t, end.t - end.lo, 0.0}) * (1 + gamma(4));
      out.push_back({end.t, bound, 0, entering, false});
      entering = !entering;
    };
    for (std::size_t i = 0; i < roots.size(); ++i) {
      const CrossingRoot& root = roots[i];
      if (start_is_due && root.t >= 0) {
        report({});
        start_is_due = false;
      }
      End end = lateral_end({root.t * scale, root.lo * scale, root.hi * scale}, moved, 0);
      if (!from_surface) {
        double gap = std::numeric_limits<double>::infinity();  // to the other roots
        if (i > 0) gap = scale * (root.t - roots[i - 1].t);
        if (i + 1 < roots.size()) gap = std::min(gap, scale * (roots[i + 1].t - root.t));
        settle(ray, root.rising, gap, end);
      }
      report(end);
    }
    if (start_is_due) report({});
  }

  // Gives a crossing the t that others find, where it certainly is the same root that they do, and the crossings stay
  // in their order. The interval still holds the exact one.
  void settle(const LocalRay& ray, bool rising, double gap, End& end) const {
    const SettledTorusRoot root(R, r, ray, end.t);
    const bool is_same = root.rising == rising && std::fabs(root.t - end.t) <= std::min(root.step / 8, gap / 4);
    if (!root.settled || !is_same) return;
    end.t = root.t;
    end.lo = std::min(end.lo, end.t);
    end.hi = std::max(end.hi, end.t);
  }
};

// With c the centre of the box, δ any way from it to its points, u the direction from the axis to c, v across it, and
// ρ(c + δ) the distance from the axis: the squared distance to the circle is g = |p|² + R² - 2 R ρ, and
//   ρ(c) + u·δ <= ρ(c + δ) <= ρ(c) + u·δ + (v·δ)² / (2 ρ_min).
// So g lies below |c + δ - R u|², and above it less (R / ρ_min) (v·δ)²: to first order, the circle's nearest point is
// all that matters.
inline Region Torus::classify(const LocalBox& box) const {
  const Vec3& c = box.center;
  const Vec3 m = reach(box);
  if (m.x == 0 && m.y == 0) return Region::straddles;
  if (box.bounds.lower.z > r || box.bounds.upper.z < -r) return Region::outside;
  if (is_separated(box, gradient_at_least({1, 1, 1}, {}, box), *this)) return Region::outside;

  const double across = std::sqrt(c.x * c.x + c.y * c.y);
  if (!(across > 0)) return Region::straddles;
  const Vec3 u{c.x / across, c.y / across, 0}, v{-u.y, u.x, 0};
  LocalBox moved = box;
  moved.center = c - R * u;
  // The direction u takes three roundings, the difference one.
  moved.error += gamma(6) * Vec3{R + m.x, R + m.y, 0};
  moved.bounds = {box.bounds.lower - R * u - moved.error, box.bounds.upper - R * u + moved.error};

  if (greatest_square(moved, {1, 1, 1}) <= r * r) return Region::inside;

  // Least ρ over the box, and the greatest way across.
  const Extent radial = extent_along(box, u), sideways = extent_along(box, v);
  const double least_across = radial.least();
  if (!(least_across > 0)) {
    // The box holds part of the axis, or nearly so. It is outside when it stays within the hole.
    const double hole = R - r;
    return greatest_square(box, {1, 1, 0}) < hole * hole * (1 - gamma(4)) ? Region::outside : Region::straddles;
  }
  const double aside = std::fabs(sideways.center) + sideways.radius;
  const double correction = R / least_across * aside * aside;
  // A plane at a distance `clear` from the circle's nearest point, with the box beyond.
  const Vec3 n = gradient_at_least({1, 1, 1}, {}, moved);
  const double n_length = length(n);
  if (!(n_length > 0)) return Region::straddles;
  const double clear = extent_along(moved, n).least() / n_length;
  const bool beyond = clear > 0 && (clear * clear - correction) * (1 - gamma(16)) > r * r;
  if (beyond) return Region::outside;
  const double hole = R - r;
  return greatest_square(box, {1, 1, 0}) < hole * hole * (1 - gamma(4)) ? Region::outside : Region::straddles;
}

}  // namespace tenon
