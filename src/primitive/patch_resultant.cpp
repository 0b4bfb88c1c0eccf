#include "primitive/patch_resultant.h"

#include <cmath>

#include "tenon/math/rounding.h"

namespace tenon {

namespace {

/// A polynomial in x, and a bound on the error of each coefficient.
template <int N>
struct Factor {
  Polynomial<N> p, e;
};

template <int A, int B>
Factor<A + B> operator*(const Factor<A>& a, const Factor<B>& b) {
  Factor<A + B> product;
  for (std::size_t i = 0; i < a.p.count; ++i) {
    for (std::size_t j = 0; j < b.p.count; ++j) {
      const double term = a.p.c[i] * b.p.c[j];
      product.p.c[i + j] += term;
      // A product and at most thirteen sums.
      product.e.c[i + j] +=
          std::fabs(a.p.c[i]) * b.e.c[j] + a.e.c[i] * (std::fabs(b.p.c[j]) + b.e.c[j]) + gamma(16) * std::fabs(term);
    }
  }
  return product;
}
template <int N>
Factor<N> sum(const Factor<N>& a, double sign, const Factor<N>& b) {
  Factor<N> s;
  for (std::size_t i = 0; i < a.p.count; ++i) {
    s.p.c[i] = a.p.c[i] + sign * b.p.c[i];
    s.e.c[i] = a.e.c[i] + b.e.c[i] + unit_roundoff * std::fabs(s.p.c[i]);
  }
  return s;
}
template <int N>
Factor<N> operator+(const Factor<N>& a, const Factor<N>& b) {
  return sum(a, 1, b);
}
template <int N>
Factor<N> operator-(const Factor<N>& a, const Factor<N>& b) {
  return sum(a, -1, b);
}

/// A function's coefficients of 1, y, y², y³, each a polynomial in x; x and y run from -1 to 1 over the square, which
/// keeps all of them as small as the net.
using Columns = std::array<Factor<3>, 4>;

Columns in_powers(const BezierNet<double>& net, double error) {
  // Eighths of the powers of x in Bernstein's polynomials at (1 + x) / 2.
  constexpr double weight[4][4] = {{1, 3, 3, 1}, {-3, -3, 3, 3}, {3, -3, -3, 3}, {-1, 3, -3, 1}};
  Columns columns;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      double value = 0, size = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
          const double w = weight[a][i] * weight[b][j] / 64;
          value += w * net[4 * i + j];
          size += std::fabs(w) * (error + gamma(20) * std::fabs(net[4 * i + j]));
        }
      }
      columns[b].p.c[a] = value;
      columns[b].e.c[a] = size * (1 + gamma(40));
    }
  }
  return columns;
}

}  // namespace

void isolate_by_resultant(const BezierNet<double>& f_net, const BezierNet<double>& g_net, double error,
                          RootPieces& pieces) {
  const Columns f = in_powers(f_net, error), g = in_powers(g_net, error);
  const auto pair = [&](std::size_t i, std::size_t j) { return f[i] * g[j] - f[j] * g[i]; };
  const Factor<6> b00 = pair(1, 0), b01 = pair(2, 0), b02 = pair(3, 0), b12 = pair(3, 1), b22 = pair(3, 2);
  const Factor<6> b11 = b02 + pair(2, 1);
  const Factor<18> determinant =
      b00 * (b11 * b22 - b12 * b12) - b01 * (b01 * b22 - b12 * b02) + b02 * (b01 * b12 - b11 * b02);
  // The bounds have been rounded themselves.
  BoundedPolynomial<18> resultant{determinant.p, determinant.e};
  for (double& e : resultant.coefficient_error.c) e *= 1 + gamma(200);
  pieces.clear();
  IntervalIsolation(resultant).isolate(-1, 1, pieces);
  for (RootPiece& piece : pieces) {
    piece.begin = 0.5 + 0.5 * piece.begin;
    piece.end = 0.5 + 0.5 * piece.end;
  }
}

}  // namespace tenon
