#pragma once

#include <cmath>

namespace tenon {

/// Unit roundoff of double: every operation +, -, *, /, sqrt errs by at most this, relatively.
inline constexpr double unit_roundoff = 0x1p-53;

/// Bound on the relative error of n roundings in a row: n u / (1 - n u), Higham, "Accuracy and Stability of Numerical
/// Algorithms", lemma 3.1.
constexpr double gamma(int n) {
  return n * unit_roundoff / (1 - n * unit_roundoff);
}

/// The exact error of a rounded sum: a + b = sum + sum_error(a, b, sum) (Knuth, TAOCP 2, section 4.2.2, theorem B).
/// @param sum  fl(a + b)
constexpr double sum_error(double a, double b, double sum) {
  const double b_part = sum - a;
  return (a - (sum - b_part)) + (b - b_part);
}

/// The exact error of a rounded product: a b = product + product_error(a, b, product).
/// @param product  fl(a b)
inline double product_error(double a, double b, double product) {
  return std::fma(a, b, -product);
}

}  // namespace tenon
