#pragma once

namespace tenon {

/// Unit roundoff of double: every operation +, -, *, /, sqrt errs by at most this, relatively.
inline constexpr double unit_roundoff = 0x1p-53;

/// Bound on the relative error of n roundings in a row: n u / (1 - n u), Higham, "Accuracy and Stability of Numerical
/// Algorithms", lemma 3.1.
constexpr double gamma(int n) { return n * unit_roundoff / (1 - n * unit_roundoff); }

}  // namespace tenon
