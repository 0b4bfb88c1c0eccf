#pragma once

#include <array>

#include "primitive/bezier_patch.h"

namespace tenon {

/// What makes Bézier's control points of those of another basis: row i gives the weights of the four.
using BasisMatrix = std::array<std::array<double, 4>, 4>;

/// Beta-splines (Barsky 1981): with a bias of 1 and a tension of 0 they are uniform cubic B-splines.
inline BasisMatrix beta_spline(double bias, double tension) {
  const double b = bias, b2 = b * b, b3 = b2 * b;
  const double delta = tension + 2 * b3 + 4 * b2 + 4 * b + 2;
  BasisMatrix m{{{2 * b3, 4 * b2 + 4 * b + tension, 2, 0},
                 {0, 2 * b3 + 4 * b2 + 2 * b + tension, 2 + 2 * b, 0},
                 {0, 2 * b3 + 2 * b2, 2 * b2 + 4 * b + tension + 2, 0},
                 {0, 2 * b3, 4 * b2 + 4 * b + tension, 2}}};
  for (auto& row : m) {
    for (double& weight : row) weight /= delta;
  }
  return m;
}

/// Bézier's control points of a patch given in another basis.
inline BezierNet<Vec3> blended(const BezierNet<Vec3>& net, const BasisMatrix& weights) {
  BezierNet<Vec3> rows{}, out{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) rows[4 * i + j] += weights[i][k] * net[4 * k + j];
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) out[4 * i + j] += weights[j][k] * rows[4 * i + k];
    }
  }
  return out;
}

}  // namespace tenon
