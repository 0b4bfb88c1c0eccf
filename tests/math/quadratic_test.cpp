#include "math/quadratic.h"

#include <gtest/gtest.h>

#include "support/quad.h"
#include "support/random.h"
#include "tenon/math/rounding.h"

namespace tenon {
namespace {

using exact::Quad;
using Shape = QuadraticSet::Shape;

struct Coefficients {
  double a, b, c;
};

// Roots from far apart to nearly equal, a leading coefficient down to nothing.
Coefficients draw(Random& random) {
  const double a = random.sign() * (random.chance(0.1) ? 0 : random.magnitude(-20, 2));
  const double b = random.uniform(-1, 1);
  if (random.chance(0.5)) return {a, b, random.uniform(-1, 1)};
  // A double root but for a little.
  const double root = random.uniform(-1, 1);
  return {a, -a * root, a * root * root + a * random.sign() * random.magnitude(-18, 0)};
}

bool has_roots(const QuadraticSet& set) {
  return set.shape == Shape::between || set.shape == Shape::outside;
}

double rounding(const Coefficients& q, double t) {
  return gamma(8) * (std::fabs(q.a) * t * t + 2 * std::fabs(q.b * t) + std::fabs(q.c));
}

// Within |t| <= 2, wherever no interval says otherwise, the sign of every polynomial within the error is as told.
TEST(SolveQuadratic, HoldsForEveryPolynomialWithinTheError) {
  Random random(1);
  for (int n = 0; n < 200'000; ++n) {
    const Coefficients q = draw(random);
    if (q.a == 0 && q.b == 0) continue;
    const double error = (random.chance(0.3) ? 0 : random.magnitude(-18, -3)) + rounding(q, 2);
    const QuadraticSet set = solve_quadratic(q.a, q.b, q.c, error);
    const double shift = (error - rounding(q, 2)) * random.uniform(-1, 1);
    for (int k = 0; k < 6; ++k) {
      double t = random.uniform(-2, 2);
      if (k == 1) t = std::nextafter(set.first.lo, -9);
      if (k == 2) t = std::nextafter(set.first.hi, 9);
      if (k == 3) t = std::nextafter(set.second.lo, -9);
      if (k == 4) t = std::nextafter(set.second.hi, 9);
      const auto holds = [t](const BoundedRoot& r) { return r.lo <= t && t <= r.hi; };
      if (!(std::fabs(t) <= 2) || (has_roots(set) && (holds(set.first) || holds(set.second)))) continue;
      const bool between = set.first.t <= t && t <= set.second.t;
      const bool inside = set.shape == Shape::all || (set.shape == Shape::between && between) ||
                          (set.shape == Shape::outside && !between);
      const Quad value = (Quad(q.a) * t + 2 * Quad(q.b)) * t + q.c + shift;
      ASSERT_EQ(inside, value <= 0) << q.a << ' ' << q.b << ' ' << q.c << " ± " << error << " at " << t;
    }
  }
}

// Two versions of one polynomial, each within its own error: a pair that only one of them reports is one whose
// intervals meet.
TEST(SolveQuadratic, APairThatOneVersionLacksCountsAsOneRoot) {
  Random random(2);
  int differing = 0;
  for (int n = 0; n < 300'000; ++n) {
    const double a = random.sign() * random.magnitude(-3, 1), b = random.uniform(-1, 1);
    const double truth = b * b / a + random.sign() * random.magnitude(-16, -6);
    const double e1 = random.magnitude(-15, -6), e2 = random.magnitude(-15, -6);
    const Coefficients one{a, b, truth + e1 * random.uniform(-1, 1)};
    const Coefficients two{a, b, truth + e2 * random.uniform(-1, 1)};
    const QuadraticSet x = solve_quadratic(a, b, one.c, e1 + rounding(one, 2 * b / a));
    const QuadraticSet y = solve_quadratic(a, b, two.c, e2 + rounding(two, 2 * b / a));
    if (has_roots(x) != has_roots(y)) {
      ++differing;
      const QuadraticSet& seen = has_roots(x) ? x : y;
      EXPECT_GE(seen.first.hi, seen.second.lo);
    } else if (has_roots(x)) {
      EXPECT_TRUE(x.first.lo <= y.first.hi && y.first.lo <= x.first.hi);
      EXPECT_TRUE(x.second.lo <= y.second.hi && y.second.lo <= x.second.hi);
    }
  }
  EXPECT_GT(differing, 1000);
}

TEST(SolveQuadratic, RootsAtInfinity) {
  const double infinity = std::numeric_limits<double>::infinity();
  QuadraticSet set = solve_quadratic(0, -0.5, 3, 0);  // 3 - t <= 0
  EXPECT_EQ(set.shape, Shape::between);
  EXPECT_EQ(set.first.t, 3);
  EXPECT_EQ(set.second.t, infinity);
  set = solve_quadratic(0, 0.5, 3, 0);
  EXPECT_EQ(set.first.t, -infinity);
  EXPECT_EQ(set.second.t, -3);
  EXPECT_EQ(solve_quadratic(0, 0, 1, 0.5).shape, Shape::none);
  EXPECT_EQ(solve_quadratic(0, 0, 1, 1).shape, Shape::all);
  EXPECT_EQ(solve_quadratic(1, 0, 1, 0).shape, Shape::none);
  EXPECT_EQ(solve_quadratic(-1, 0, -1, 0).shape, Shape::all);
}

TEST(SolveDeflated, HoldsTheOtherRoot) {
  Random random(3);
  for (int n = 0; n < 100'000; ++n) {
    const double a = random.sign() * random.magnitude(-6, 2), b = random.sign() * random.magnitude(-6, 2);
    const double a_error = random.magnitude(-16, -3), b_error = random.magnitude(-16, -3);
    const BoundedRoot root = solve_deflated(a, b, a_error, b_error);
    const Quad a_true = Quad(a) + Quad(a_error * random.uniform(-1, 1));
    const Quad b_true = Quad(b) + Quad(b_error * random.uniform(-1, 1));
    if ((a_true < 0) != (a < 0)) continue;  // beyond infinity, on the other side
    const double t = static_cast<double>(-2 * b_true / a_true);
    const double slip = 4 * unit_roundoff * std::fabs(t);
    EXPECT_LE(root.lo, t + slip) << a << ' ' << b << ' ' << a_error << ' ' << b_error;
    EXPECT_GE(root.hi, t - slip) << a << ' ' << b << ' ' << a_error << ' ' << b_error;
  }
}

}  // namespace
}  // namespace tenon
