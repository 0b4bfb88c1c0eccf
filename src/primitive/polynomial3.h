#pragma once

#include <cstddef>
#include <vector>

#include "math/polynomial.h"
#include "primitive/box_tests.h"
#include "primitive/local_ray.h"
#include "tenon/primitive/polynomial_terms.h"

namespace tenon {

/// The algebraic function f(x, y, z) = Σ a_ijk xⁱ yʲ zᵏ (course, "Intersection with algebraic surfaces").
class Polynomial3 {
 public:
  /// Above this degree the roots along a line are no longer told apart by double.
  static constexpr int most_degree = 12;

  Polynomial3() = default;
  /// @param terms           of degree at most most_degree, exponents >= 0
  /// @param relative_error  of each term
  explicit Polynomial3(const PolynomialTerms& terms, double relative_error = 0);

  int degree() const { return degree_; }

  double value(const Vec3& p) const;
  Vec3 gradient(const Vec3& p) const;
  /// Σ |a_ijk xⁱ yʲ zᵏ|, which bounds f and its rounding.
  double size(const Vec3& p) const;

  /// f along a line, as a polynomial in s: the place is origin + (moved + scale s) direction. The errors of its
  /// coefficients hold for the exact line of the scene.
  /// @param N  at least the degree
  template <int N>
  BoundedPolynomial<N> along(const LocalRay& ray, double moved, double scale) const;

  /// Bounds of f over a box, right to first order in the box's size.
  Extent range(const LocalBox& box) const;

 private:
  std::size_t side() const { return static_cast<std::size_t>(degree_) + 1; }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const { return (i * side() + j) * side() + k; }
  /// Horner's scheme, in z within y within x. `Sum` has multiply(axis), by a coordinate, and add(Sum) and add(a, e), of
  /// a coefficient that is known to within e.
  template <class Sum>
  Sum evaluate(const Sum& zero) const;

  int degree_ = 0;
  std::vector<double> a_;      // dense: (degree + 1)³, those beyond the degree are 0
  std::vector<double> error_;  // of adding terms up
};

}  // namespace tenon
