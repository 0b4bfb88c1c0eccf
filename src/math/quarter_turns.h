#pragma once

#include <cmath>

namespace tenon {

struct SineCosine {
  double sine, cosine;
};

/// How far quarter_turn_sine_cosine() may be off, for an angle that is exact: see there.
inline constexpr double sine_cosine_error = 0x1p-50;
inline constexpr double half_pi = 0x1.921fb54442d18p+0;

/// Sine and cosine of an angle in quarter turns, |q| < 2^50, by the same arithmetic on every machine.
///
/// Whole quarter turns are taken out exactly; what is left is at most an eighth of a turn, x = pi/4. There Taylor's
/// series up to x^17 and x^18 err by x^19/19! and x^20/20!, below 2^-63. x itself takes two roundings, and Horner's
/// scheme as many as it has steps, of terms that shrink from 1: less than 6 u in all, u = 2^-53.
inline SineCosine quarter_turn_sine_cosine(double q) {
  const double whole = std::floor(q + 0.5);
  const double x = (q - whole) * half_pi, s = x * x;
  constexpr double odd[] = {-1.0 / 6,        1.0 / 120,          -1.0 / 5040,         1.0 / 362880,
                            -1.0 / 39916800, 1.0 / 6227020800.0, -1.0 / 1307674368e3, 1.0 / 355687428096e3};
  constexpr double even[] = {-1.0 / 2,
                             1.0 / 24,
                             -1.0 / 720,
                             1.0 / 40320,
                             -1.0 / 3628800,
                             1.0 / 479001600.0,
                             -1.0 / 87178291200.0,
                             1.0 / 20922789888e3,
                             -1.0 / 6402373705728e3};
  double sine = 0, cosine = 0;
  for (int i = 7; i >= 0; --i) sine = (sine + odd[i]) * s;
  for (int i = 8; i >= 0; --i) cosine = (cosine + even[i]) * s;
  sine = x + x * sine;
  cosine = 1 + cosine;
  // Which quarter, without branches: compilers make vectors of loops over angles.
  const double quarter = whole - 4 * std::floor(whole / 4);
  const bool is_odd = quarter == 1 || quarter == 3;
  const double along = is_odd ? cosine : sine, across = is_odd ? -sine : cosine;
  return {quarter >= 2 ? -along : along, quarter >= 2 ? -across : across};
}

}  // namespace tenon
