#pragma once

#include <array>
#include <cstddef>

#include "tenon/math/box3.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// Sixteen values over the unit square, the coefficients of a bicubic function in Bernstein's basis: [4 i + j] stands
/// at u = i / 3, v = j / 3. All values of the function lie between the least and the greatest of them.
template <class T>
using BezierNet = std::array<T, 16>;

/// Bernstein's cubic polynomials at u, with rounding that is the same at 1 - u, backwards: so two patches have the same
/// points on an edge that they share, whichever way they run along it.
inline std::array<double, 4> bernstein(double u, double rest) {
  return {(rest * rest) * rest, 3 * ((rest * rest) * u), 3 * ((u * u) * rest), (u * u) * u};
}

template <class T>
T blend(const std::array<double, 4>& b, const T& p0, const T& p1, const T& p2, const T& p3) {
  return (b[0] * p0 + b[3] * p3) + (b[1] * p1 + b[2] * p2);
}

/// The value at u and v, `u_rest` being 1 - u, `v_rest` 1 - v.
template <class T>
T point_on(const BezierNet<T>& net, double u, double u_rest, double v, double v_rest) {
  const std::array<double, 4> bu = bernstein(u, u_rest), bv = bernstein(v, v_rest);
  std::array<T, 4> along{};
  for (std::size_t i = 0; i < 4; ++i) along[i] = blend(bv, net[4 * i], net[4 * i + 1], net[4 * i + 2], net[4 * i + 3]);
  return blend(bu, along[0], along[1], along[2], along[3]);
}

/// A place on a patch, and how it moves with u and v.
template <class T>
struct PatchPoint {
  T value{}, by_u{}, by_v{};
};

template <class T>
PatchPoint<T> evaluate(const BezierNet<T>& net, double u, double v) {
  const std::array<double, 4> bu = bernstein(u, 1 - u), bv = bernstein(v, 1 - v);
  const auto slopes = [](double x) {
    const double rest = 1 - x;
    return std::array<double, 4>{-3 * rest * rest, 3 * rest * (rest - 2 * x), 3 * x * (2 * rest - x), 3 * x * x};
  };
  const std::array<double, 4> du = slopes(u), dv = slopes(v);
  std::array<T, 4> along{}, across{};
  for (std::size_t i = 0; i < 4; ++i) {
    const T* row = &net[4 * i];
    along[i] = blend(bv, row[0], row[1], row[2], row[3]);
    across[i] = blend(dv, row[0], row[1], row[2], row[3]);
  }
  return {blend(bu, along[0], along[1], along[2], along[3]), blend(du, along[0], along[1], along[2], along[3]),
          blend(bu, across[0], across[1], across[2], across[3])};
}

/// The part of a net between two places in u (rows) or v (columns), by blossoming.
template <class T>
BezierNet<T> restricted(const BezierNet<T>& net, bool in_u, double from, double to) {
  const std::size_t step = in_u ? 4 : 1, other = in_u ? 1 : 4;
  BezierNet<T> out;
  const auto mix = [](double s, const T& a, const T& b) { return (1 - s) * a + s * b; };
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t at = other * k;
    for (std::size_t i = 0; i < 4; ++i) {
      // 3 - i arguments are `from`, i are `to`.
      std::array<T, 4> p{net[at], net[at + step], net[at + 2 * step], net[at + 3 * step]};
      for (std::size_t level = 0; level < 3; ++level) {
        const double s = level < 3 - i ? from : to;
        for (std::size_t m = 0; m + level < 3; ++m) p[m] = mix(s, p[m], p[m + 1]);
      }
      out[at + i * step] = p[0];
    }
  }
  return out;
}

/// Both halves of a net, in u or in v, by de Casteljau's scheme.
template <class T>
void halve(const BezierNet<T>& net, bool in_u, BezierNet<T>& first, BezierNet<T>& second) {
  const std::size_t step = in_u ? 4 : 1, other = in_u ? 1 : 4;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t at = other * k;
    const T &a = net[at], &b = net[at + step], &c = net[at + 2 * step], &d = net[at + 3 * step];
    const T ab = 0.5 * (a + b), bc = 0.5 * (b + c), cd = 0.5 * (c + d);
    const T abc = 0.5 * (ab + bc), bcd = 0.5 * (bc + cd);
    const T middle = 0.5 * (abc + bcd);
    first[at] = a;
    first[at + step] = ab;
    first[at + 2 * step] = abc;
    first[at + 3 * step] = middle;
    second[at] = middle;
    second[at + step] = bcd;
    second[at + 2 * step] = cd;
    second[at + 3 * step] = d;
  }
}

}  // namespace tenon
