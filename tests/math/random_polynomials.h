#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "math/polynomial.h"
#include "support/quad.h"
#include "support/random.h"

/// Polynomials with roots that were chosen, and what solving them must come to.
namespace tenon {

using exact::Quad;

template <int N>
using Exact = std::array<Quad, static_cast<std::size_t>(N) + 1>;

template <int N>
Exact<N> with_roots(const std::vector<double>& roots) {
  Exact<N> c{};
  c[0] = 1;
  for (const double root : roots) {
    for (std::size_t i = c.size() - 1; i > 0; --i) c[i] = c[i - 1] - Quad(root) * c[i];
    c[0] = -Quad(root) * c[0];
  }
  return c;
}

template <int N>
Quad evaluate(const Exact<N>& c, Quad t) {
  Quad v = 0;
  for (std::size_t i = c.size(); i-- > 0;) v = v * t + c[i];
  return v;
}

/// The polynomial as double has it, with the error of each coefficient.
template <int N>
BoundedPolynomial<N> rounded(const Exact<N>& truth) {
  Polynomial<N> p, error;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    p.c[i] = static_cast<double>(truth[i]);
    error.c[i] = static_cast<double>(exact::absolute(truth[i] - Quad(p.c[i]))) * (1 + 1e-15);
  }
  return {p, error};
}

/// Random roots, some of them equal but for a little and some complex. Wherever no interval holds t, the sign of the
/// exact polynomial is that which the roots before t tell.
///
/// @param solve  solve(polynomial, a, b): the roots between a and b
template <int N, class Solve>
void check_random_polynomials(int count, const Solve& solve) {
  Random random(N);
  int reported = 0, clusters = 0;
  for (int n = 0; n < count; ++n) {
    std::vector<double> roots;
    while (roots.size() < static_cast<std::size_t>(N)) {
      const bool near = !roots.empty() && random.chance(0.3);
      roots.push_back(near ? roots.back() + random.magnitude(-17, -2) : random.uniform(-1.5, 1.5));
    }
    Exact<N> truth = with_roots<N>(roots);
    // Lifted, so that some roots become complex.
    if (random.chance(0.3)) truth[0] += random.sign() * random.magnitude(-17, -1);
    const BoundedPolynomial<N> f = rounded<N>(truth);
    const auto found = solve(f, -1.0, 1.0);
    reported += static_cast<int>(found.size());
    std::vector<double> places{-1, 1};
    for (std::size_t i = 0; i < found.size(); ++i) {
      const CrossingRoot& r = found[i];
      ASSERT_TRUE(r.lo <= r.t && r.t <= r.hi);
      if (i > 0) {
        ASSERT_GE(r.t, found[i - 1].t);
        ASSERT_NE(r.rising, found[i - 1].rising);
        clusters += r.lo <= found[i - 1].hi;
      }
      places.push_back(std::nextafter(r.lo, -2));
      places.push_back(std::nextafter(r.hi, 2));
    }
    for (int k = 0; k < 10; ++k) places.push_back(random.uniform(-1, 1));
    for (const double t : places) {
      bool undecided = t < -1 || t > 1 || std::fabs(f.value(t)) <= f.error(t);
      bool positive = found.empty() ? f.value(-1) > 0 : !found[0].rising;
      for (const CrossingRoot& r : found) {
        undecided |= r.lo <= t && t <= r.hi;
        if (r.t <= t) positive = r.rising;
      }
      if (undecided) continue;
      ASSERT_EQ(positive, evaluate<N>(truth, t) > 0) << "degree " << N << ", t = " << t << ", roots " << found.size();
    }
  }
  EXPECT_GT(reported, count / 2);
  EXPECT_GT(clusters, N > 1 ? count / 200 : -1) << N;
}

}  // namespace tenon
