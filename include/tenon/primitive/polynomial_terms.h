#pragma once

#include <array>
#include <vector>

namespace tenon {

/// a xⁱ yʲ zᵏ.
struct PolynomialTerm {
  int i = 0, j = 0, k = 0;
  double a = 0;

  friend constexpr bool operator==(const PolynomialTerm&, const PolynomialTerm&) = default;
};

/// A polynomial in x, y and z: the sum of its terms, in any order. Terms with the same exponents are added.
using PolynomialTerms = std::vector<PolynomialTerm>;

/// A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + I z + J, from A to J (the order of POV-Ray's quadric).
using QuadricCoefficients = std::array<double, 10>;

}  // namespace tenon
