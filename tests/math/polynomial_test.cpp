#include "math/polynomial.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/quad.h"
#include "support/random.h"
#include "tenon/math/affine3.h"

namespace tenon {
namespace {

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

// The polynomial as double has it, with the error of each coefficient.
template <int N>
BoundedPolynomial<N> rounded(const Exact<N>& truth) {
  Polynomial<N> p, error;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    p.c[i] = static_cast<double>(truth[i]);
    error.c[i] = static_cast<double>(exact::absolute(truth[i] - Quad(p.c[i]))) * (1 + 1e-15);
  }
  return {p, error};
}

// Random roots, some of them equal but for a little and some complex. Wherever no interval holds t, the sign of the
// exact polynomial is that which the roots before t tell.
template <int N>
void check_random_polynomials(int count) {
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
    const auto found = solve_polynomial(f, -1, 1);
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

TEST(SolvePolynomial, AgreesWith113BitsInEveryDegreeToTen) {
  check_random_polynomials<1>(10'000);
  check_random_polynomials<2>(10'000);
  check_random_polynomials<3>(10'000);
  check_random_polynomials<4>(10'000);
  check_random_polynomials<5>(5'000);
  check_random_polynomials<6>(5'000);
  check_random_polynomials<8>(5'000);
  check_random_polynomials<10>(5'000);
}

TEST(SolvePolynomial, FindsTheEightRootsOfAChebyshevPolynomial) {
  const auto roots = solve_polynomial(BoundedPolynomial<8>{{{1, 0, -32, 0, 160, 0, -256, 0, 128}}, {}}, -1, 1);
  ASSERT_EQ(roots.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    const double truth = cos_degrees((15 - 2.0 * static_cast<double>(i)) * 180 / 16);
    EXPECT_NEAR(roots[i].t, truth, 2e-15);
    EXPECT_LT(roots[i].hi - roots[i].lo, 2e-13);
    EXPECT_EQ(roots[i].rising, i % 2 == 1);
  }
}

TEST(SolvePolynomial, MultipleRootsComeInPairsOrNotAtAll) {
  // (t² - 1/4)²: touches zero twice from above.
  const auto touching = solve_polynomial(BoundedPolynomial<4>{{{0.0625, 0, -0.5, 0, 1}}, {}}, -1, 1);
  EXPECT_EQ(touching.size() % 2, 0u);
  for (std::size_t i = 0; i + 1 < touching.size(); i += 2) EXPECT_GE(touching[i].hi, touching[i + 1].lo);
  // t³ crosses once.
  EXPECT_EQ(solve_polynomial(BoundedPolynomial<3>{{{0, 0, 0, 1}}, {}}, -1, 1).size() % 2, 1u);
  // t⁴ + 1e-3 has none; t⁴ touches.
  EXPECT_TRUE(solve_polynomial(BoundedPolynomial<4>{{{1e-3, 0, 0, 0, 1}}, {}}, -1, 1).empty());
  EXPECT_EQ(solve_polynomial(BoundedPolynomial<4>{{{0, 0, 0, 0, 1}}, {}}, -1, 1).size() % 2, 0u);
  // A zero polynomial says nothing, and does not hang.
  EXPECT_EQ(solve_polynomial(BoundedPolynomial<4>{}, -1, 1).size() % 2, 0u);
}

}  // namespace
}  // namespace tenon
