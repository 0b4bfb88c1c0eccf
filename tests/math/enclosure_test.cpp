#include "math/enclosure.h"

#include <gtest/gtest.h>

#include "support/quad.h"
#include "support/random.h"

namespace tenon {
namespace {

using exact::Quad;

bool holds(const Ball& ball, Quad value) {
  const Quad away = value - Quad(ball.middle);
  return away <= Quad(ball.radius) && -away <= Quad(ball.radius);
}

TEST(QuarterTurns, ErrorsStayWithinTheirBound) {
  Random random(1);
  for (int n = 0; n < 20'000; ++n) {
    const double q = random.chance(0.2) ? 0.5 * random.below(100) : random.sign() * random.magnitude(-20, 4);
    const auto [sine, cosine] = quarter_turn_sine_cosine(q);
    EXPECT_TRUE(holds({sine, sine_cosine_error}, exact::sine(90 * Quad(q)))) << q;
    EXPECT_TRUE(holds({cosine, sine_cosine_error}, exact::cosine(90 * Quad(q)))) << q;
  }
}

// f(t) = (a + b t) sin(q t) - c cos(q t) over an interval, against its values in 113 bits.
TEST(Enclosure, HoldsEveryValueAndSlope) {
  Random random(2);
  for (int n = 0; n < 2'000; ++n) {
    const double a = random.uniform(-2, 2), b = random.uniform(-2, 2), c = random.uniform(-2, 2);
    const double q = random.uniform(-3, 3), middle = random.uniform(-1, 1), half = random.magnitude(-12, 0);
    const EnclosureArithmetic with(half);
    const auto line = [&](double offset, double slope) {
      const Ball at_middle = Ball{offset, 0} + slope * Ball{middle, 0};
      return Enclosure::of(at_middle, {slope, 0}, {0, 0}, half);
    };
    Enclosure sine, cosine;
    with.sine_cosine(line(0, q), sine, cosine);
    const Enclosure f = with.subtract(with.multiply(line(a, b), sine), with.multiply(c, cosine));
    const auto value = [&](Quad t) {
      return (Quad(a) + Quad(b) * t) * exact::sine(90 * Quad(q) * t) - Quad(c) * exact::cosine(90 * Quad(q) * t);
    };
    ASSERT_TRUE(holds(f.middle, value(middle))) << n;
    for (int k = 0; k < 8; ++k) {
      const Quad t = Quad(middle) + Quad(half) * random.uniform(-1, 1);
      ASSERT_TRUE(holds(f.range, value(t))) << n;
      // A chord's slope is the derivative at some place between.
      const Quad step = (t > Quad(middle) ? -0.25 : 0.25) * Quad(half);
      ASSERT_TRUE(holds(f.slope, (value(t + step) - value(t)) / step)) << n;
    }
  }
}

}  // namespace
}  // namespace tenon
