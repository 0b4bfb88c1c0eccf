#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/check.h"
#include "primitive/concept.h"
#include "primitive/revolved_quadric.h"

namespace tenon {

/// One sheet around z: x² + y² <= waist² + (slope z)² for -h/2 <= z <= h/2, with radius r at both caps.
class Hyperboloid {
 public:
  double h = 1;
  double r = 1;
  double waist = 0.5;

  static constexpr std::string_view name = "hyperboloid", scad_name = "hyperboloid";
  static constexpr std::string_view doc = "A hyperboloid of one sheet around z, capped at half its height up and down.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 2.2;
  static constexpr auto fields() {
    return std::tuple{Field{"h", Unit::length, &Hyperboloid::h, "height"},
                      Field{"r", Unit::length, &Hyperboloid::r, "radius of both caps"},
                      Field{"waist", Unit::length, &Hyperboloid::waist, "radius at z = 0, at most r"}};
  }

  std::string check() const {
    const std::string problem = check_lengths(name, {{"h", h}, {"r", r}, {"waist", waist}});
    if (!problem.empty()) return problem;
    if (waist > r) {
      return "hyperboloid with waist = " + shortest(waist) + " and r = " + shortest(r) +
             " bulges; its waist must not exceed its radius";
    }
    return {};
  }

  void prepare() {
    q_.low = -0.5 * h;
    q_.high = 0.5 * h;
    q_.slope = std::sqrt((r - waist) * (r + waist)) / q_.high;
    q_.constant = waist * waist;
    q_.greatest_radius = r;
  }

  /// The convex hull is that of the caps.
  double support(const Vec3& n) const { return r * std::sqrt(n.x * n.x + n.y * n.y) + std::fabs(n.z) * q_.high; }

  const RevolvedQuadric& quadric() const { return q_; }
  /// Faces: RevolvedQuadric::Face.
  void spans(const LocalRay& ray, Spans& out) const { q_.spans(ray, out); }

  Region classify(const LocalBox& box) const {
    if (box.bounds.upper.z < q_.low || box.bounds.lower.z > q_.high) return Region::outside;
    const Extent range = q_.range(box);
    if (range.least() > 0) return Region::outside;
    const bool between_caps = box.bounds.lower.z >= q_.low && box.bounds.upper.z <= q_.high;
    if (between_caps && range.greatest() < 0) return Region::inside;
    if (is_separated(box, gradient_at_least({1, 1, 0}, {}, box), *this)) return Region::outside;
    return is_separated_by_box_faces(box, *this) ? Region::outside : Region::straddles;
  }

  std::uint32_t face_count() const { return 3; }
  Vec3 normal(const Vec3& point, std::uint32_t face) const {
    if (face != RevolvedQuadric::side) return {0, 0, face == RevolvedQuadric::top ? 1.0 : -1.0};
    return q_.gradient(point);
  }

 private:
  RevolvedQuadric q_;
};

}  // namespace tenon
