#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/check.h"
#include "primitive/concept.h"
#include "primitive/revolved_quadric.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// A cone or its frustum: x² + y² <= w(z)² between two caps, w going from r1 at the lower to r2 at the upper one.
class Cone {
 public:
  double h = 1;
  double r1 = 1;
  double r2 = 0;
  bool center = false;

  static constexpr std::string_view name = "cone", scad_name = "cylinder";
  static constexpr std::string_view doc = "A cone around z, or its frustum.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 2;
  static constexpr auto fields() {
    return std::tuple{Field{"h", Unit::length, &Cone::h, "height"},
                      Field{"r1", Unit::length, &Cone::r1, "radius of the lower cap"},
                      Field{"r2", Unit::length, &Cone::r2, "radius of the upper cap"},
                      Field{"center", Unit::none, &Cone::center, "around z = 0 instead of above it"}};
  }

  std::string check() const {
    if (r1 == 0 && r2 == 0) return "cone with r1 = 0 and r2 = 0 has no volume";
    return check_lengths(name, {{"h", h}, {"r1", r1, true}, {"r2", r2, true}});
  }

  void prepare() {
    q_.low = center ? -0.5 * h : 0;
    q_.high = center ? 0.5 * h : h;
    q_.slope = (r2 - r1) / h;
    q_.offset = center ? 0.5 * (r1 + r2) : r1;
    q_.greatest_radius = std::max(r1, r2);
  }

  double support(const Vec3& n) const {
    const double across = std::sqrt(n.x * n.x + n.y * n.y);
    return std::max(r1 * across + q_.low * n.z, r2 * across + q_.high * n.z);
  }

  const RevolvedQuadric& quadric() const { return q_; }
  /// Faces: RevolvedQuadric::Face.
  void spans(const LocalRay& ray, Spans& out) const { q_.spans(ray, out); }

  Region classify(const LocalBox& box) const {
    if (box.bounds.upper.z < q_.low || box.bounds.lower.z > q_.high) return Region::outside;
    if (box.bounds.lower.z >= q_.low && box.bounds.upper.z <= q_.high && holds_corners(box)) return Region::inside;
    if (q_.range(box).least() > 0) return Region::outside;
    const Vec3 across = normalize(gradient_at_least({1, 1, 0}, {}, box));
    if (is_separated(box, {across.x, across.y, -q_.slope}, *this)) return Region::outside;
    return is_separated_by_box_faces(box, *this) ? Region::outside : Region::straddles;
  }

  std::uint32_t face_count() const { return 3; }
  Vec3 normal(const Vec3& point, std::uint32_t face) const {
    if (face != RevolvedQuadric::side) return {0, 0, face == RevolvedQuadric::top ? 1.0 : -1.0};
    const Vec3 n = q_.gradient(point);
    // At the very tip there is no gradient; the axis points out of it.
    return n == Vec3{} ? Vec3{0, 0, q_.slope < 0 ? 1.0 : -1.0} : n;
  }

 private:
  bool holds_corners(const LocalBox& box) const {
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = box.corner(i);
      const Vec3 p = abs(corner) + box.error;
      const double w = q_.offset + q_.slope * corner.z;
      const double least = w - std::fabs(q_.slope) * box.error.z - gamma(6) * (q_.offset + std::fabs(q_.slope) * p.z);
      if (!(least >= 0) || !((p.x * p.x + p.y * p.y) * (1 + gamma(6)) <= least * least)) return false;
    }
    return true;
  }

  RevolvedQuadric q_;
};

}  // namespace tenon
