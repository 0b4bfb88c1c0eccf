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

/// x² + y² <= (r² / h) z up to z = h.
class Paraboloid {
 public:
  double h = 1;
  double r = 1;

  static constexpr std::string_view name = "paraboloid", scad_name = "paraboloid";
  static constexpr std::string_view doc = "A paraboloid with its apex at the origin, opening along z, capped at z = h.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 2;
  static constexpr auto fields() {
    return std::tuple{Field{"h", Unit::length, &Paraboloid::h, "height"},
                      Field{"r", Unit::length, &Paraboloid::r, "radius of the cap"}};
  }

  std::string check() const { return check_lengths(name, {{"h", h}, {"r", r}}); }

  void prepare() {
    q_.low = 0;
    q_.high = h;
    q_.linear = r * r / h;
    q_.greatest_radius = r;
  }

  /// Either on the rim, or where the normal is parallel to n: at radius -|n_xy| linear / (2 n_z).
  double support(const Vec3& n) const {
    const double across = std::sqrt(n.x * n.x + n.y * n.y);
    if (n.z < 0 && across * q_.linear < -2 * n.z * r) return across * across * q_.linear / (-4 * n.z);
    return r * across + h * n.z;
  }

  const RevolvedQuadric& quadric() const { return q_; }
  /// Faces: RevolvedQuadric::Face; the apex stands in for the bottom.
  void spans(const LocalRay& ray, Spans& out) const { q_.spans(ray, out); }

  Region classify(const LocalBox& box) const {
    if (box.bounds.upper.z < 0 || box.bounds.lower.z > h) return Region::outside;
    if (box.bounds.upper.z <= h && holds_corners(box)) return Region::inside;
    if (is_separated(box, gradient_at_least({1, 1, 0}, {0, 0, -0.5 * q_.linear}, box), *this)) return Region::outside;
    return is_separated_by_box_faces(box, *this) ? Region::outside : Region::straddles;
  }

  std::uint32_t face_count() const { return 3; }
  Vec3 normal(const Vec3& point, std::uint32_t face) const {
    if (face != RevolvedQuadric::side) return {0, 0, face == RevolvedQuadric::top ? 1.0 : -1.0};
    return q_.gradient(point);
  }

 private:
  bool holds_corners(const LocalBox& box) const {
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = box.corner(i);
      const Vec3 p = abs(corner) + box.error;
      const double allowed = q_.linear * (corner.z - box.error.z - gamma(6) * p.z);
      if (!((p.x * p.x + p.y * p.y) * (1 + gamma(6)) <= allowed)) return false;
    }
    return true;
  }

  RevolvedQuadric q_;
};

}  // namespace tenon
