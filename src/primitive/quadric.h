#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>

#include "math/quadratic.h"
#include "primitive/box_tests.h"
#include "primitive/clip.h"
#include "primitive/concept.h"

namespace tenon {

/// A quadric of any kind, q(p) <= 0, unbounded or within a box:
///
///   q(p) = p·M p + 2 g·p + k,   M symmetric.
class Quadric {
 public:
  QuadricCoefficients coefficients{1, 1, 1, 0, 0, 0, 0, 0, 0, -1};
  Box3 box = Box3::everything();

  static constexpr std::string_view name = "quadric", scad_name = "quadric";
  static constexpr std::string_view doc = "Where a polynomial of degree 2 is at most 0, within a box or unbounded.";
  static constexpr bool bounded = false;
  static constexpr double relative_cost = 3;
  static constexpr auto fields() {
    return std::tuple{Field{"coefficients", Unit::none, &Quadric::coefficients,
                            "of x², y², z², xy, xz, yz, x, y, z and 1, in this order"},
                      Field{"box", Unit::length, &Quadric::box, "two corners; what lies outside does not count"}};
  }
  enum Face : std::uint32_t { surface, box_faces };  ///< the faces of the box follow, as clip_box numbers them

  void prepare();
  std::string check() const;

  double support(const Vec3& n) const;
  void spans(const LocalRay& ray, Spans& out) const;
  Region classify(const LocalBox& region) const;
  std::uint32_t face_count() const { return 7; }
  Vec3 normal(const Vec3& point, std::uint32_t face) const;

  /// q along the line, expanded at t: q(t + s) = a s² + 2 b s + c, and what the terms were before they cancelled.
  struct Expansion {
    double a, b, c;
    double a_size, b_size, c_size;
    Vec3 slope, turn;  ///< half the gradient there, and M d, its change along the line
    Vec3 place_error;  ///< bound on the error of the place within `reach` of t = 0
  };
  Expansion expand(const LocalRay& ray, double t, double reach) const;
  /// Bound on |q* - q| within `away` of the expansion point.
  double error_at(const Expansion& e, double away) const;

 private:
  Vec3 times_m(const Vec3& v) const;
  Vec3 times_m_size(const Vec3& v) const;  // |M| v
  QuadraticSet solve(const LocalRay& ray, double middle) const;
  QuadraticSet solve_for(BoundedRoot QuadraticSet::*root, const LocalRay& ray, double at, double away) const;
  QuadraticSet solve_from_surface(const LocalRay& ray) const;

  Vec3 square_, mixed_;  // the diagonal of M, and its entries yz, xz, xy
  Vec3 linear_;          // g
};

}  // namespace tenon
