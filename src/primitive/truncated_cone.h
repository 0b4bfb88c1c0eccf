#pragma once

#include <string>
#include <string_view>
#include <tuple>

#include "primitive/algebraic_solid.h"
#include "primitive/concept.h"

namespace tenon {

/// Between two ellipses at z = 0 and z = h, of different proportions: (x / a(z))² + (y / b(z))² <= 1, where a and b run
/// evenly from those of the lower ellipse to those of the upper one. A surface of degree 4.
class TruncatedCone {
 public:
  double h = 1;
  double a1 = 1;
  double b1 = 0.5;
  double a2 = 0.5;
  double b2 = 1;

  static constexpr std::string_view name = "truncated_cone", scad_name = "truncated_cone";
  static constexpr std::string_view doc = "Between two ellipses of any semi-axes.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 40;
  static constexpr auto fields() {
    return std::tuple{Field{"h", Unit::length, &TruncatedCone::h, "height"},
                      Field{"a1", Unit::length, &TruncatedCone::a1, "semi-axis along x of the lower ellipse"},
                      Field{"b1", Unit::length, &TruncatedCone::b1, "semi-axis along y of the lower ellipse"},
                      Field{"a2", Unit::length, &TruncatedCone::a2, "semi-axis along x of the upper ellipse"},
                      Field{"b2", Unit::length, &TruncatedCone::b2, "semi-axis along y of the upper ellipse"}};
  }

  void prepare();
  std::string check() const;

  double support(const Vec3& n) const;
  /// Faces: AlgebraicSolid::Face; the box's last two are the caps, its others touch the side.
  void spans(const LocalRay& ray, Spans& out) const;
  Region classify(const LocalBox& box) const;
  std::uint32_t face_count() const { return 7; }
  Vec3 normal(const Vec3& point, std::uint32_t face) const;

 private:
  AlgebraicSolid solid_;
};

}  // namespace tenon
