#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/algebraic_solid.h"
#include "primitive/concept.h"

namespace tenon {

/// The solid {f <= 0} within a box, f being a polynomial in x, y and z (course, "Intersection with algebraic
/// surfaces").
class Algebraic {
 public:
  static constexpr std::array<std::string_view, 2> isolations{"interval", "collins"};
  static constexpr std::array<std::string_view, 3> refinements{"newton", "laguerre", "bairstow"};

  PolynomialTerms terms{{2, 0, 0, 1}, {0, 2, 0, 1}, {0, 0, 2, 1}, {0, 0, 0, -1}};
  Box3 box{{-1, -1, -1}, {1, 1, 1}};
  Choice isolation{0, isolations};
  Choice refinement{0, refinements};

  static constexpr std::string_view name = "algebraic", scad_name = "algebraic";
  static constexpr std::string_view doc = "Where a polynomial is at most 0, within a box.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 40;
  static constexpr auto fields() {
    return std::tuple{
        Field{"terms", Unit::none, &Algebraic::terms, "list of [i, j, k, a] for a x^i y^j z^k, of degree 12 at most"},
        Field{"box", Unit::length, &Algebraic::box, "two corners; what lies outside does not count"},
        Field{"isolation", Unit::none, &Algebraic::isolation, "of the roots along a ray: interval or collins"},
        Field{"refinement", Unit::none, &Algebraic::refinement, "of a root: newton, laguerre or bairstow"}};
  }

  void prepare();
  std::string check() const;

  double support(const Vec3& n) const;
  /// Faces: AlgebraicSolid::Face.
  void spans(const LocalRay& ray, Spans& out) const { solid_.spans(ray, out); }
  Region classify(const LocalBox& region) const { return solid_.classify(region); }
  std::uint32_t face_count() const { return 7; }
  Vec3 normal(const Vec3& point, std::uint32_t face) const { return solid_.normal(point, face); }

 private:
  AlgebraicSolid solid_;
};

}  // namespace tenon
