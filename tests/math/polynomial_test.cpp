#include "math/polynomial.h"

#include <gtest/gtest.h>

#include "math/random_polynomials.h"
#include "tenon/math/affine3.h"

namespace tenon {
namespace {

constexpr auto solve = [](const auto& f, double a, double b) { return solve_polynomial(f, a, b); };

TEST(SolvePolynomial, AgreesWith113BitsInEveryDegreeToTen) {
  check_random_polynomials<1>(10'000, solve);
  check_random_polynomials<2>(10'000, solve);
  check_random_polynomials<3>(10'000, solve);
  check_random_polynomials<4>(10'000, solve);
  check_random_polynomials<5>(5'000, solve);
  check_random_polynomials<6>(5'000, solve);
  check_random_polynomials<8>(5'000, solve);
  check_random_polynomials<10>(5'000, solve);
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
  EXPECT_GE(touching.size(), 2u);
  for (std::size_t i = 0; i + 1 < touching.size(); i += 2) EXPECT_GE(touching[i].hi, touching[i + 1].lo);
  // Where it is told from zero on both sides, not as far as it turns again.
  for (const CrossingRoot& root : touching) EXPECT_LT(root.hi - root.lo, 1e-6);
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
