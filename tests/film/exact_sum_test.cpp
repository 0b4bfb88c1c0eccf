#include "tenon/film/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/random.h"

namespace tenon {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(ExactSum, SameInAnyOrderAndInAnyParts) {
  const std::uint64_t seed = 71;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int round = 0; round < 100; ++round) {
    std::vector<double> numbers;
    for (int i = 0; i < 200; ++i) numbers.push_back(random.sign() * random.magnitude(-15, 14));
    WideSum expected;
    for (double n : numbers) expected.add(n);
    for (std::size_t i = numbers.size(); i-- > 1;) std::swap(numbers[i], numbers[random.bits() % (i + 1)]);
    std::vector<WideSum> parts(static_cast<std::size_t>(1 + random.below(9)));
    for (double n : numbers) parts[random.bits() % parts.size()].add(n);
    WideSum sum;
    for (const WideSum& part : parts) sum += part;
    EXPECT_EQ(sum, expected);
  }
}

TEST(ExactSum, OfFloatsThatAreLightIsExact) {
  // Whatever a float from 2^-40 on is, it is a whole number of steps.
  WideSum sum;
  for (const float f : {0x1.fffffep-17F, 0x1.000002p-40F, 3.0F, -0.1F}) sum.add(static_cast<double>(f));
  EXPECT_EQ(sum.value(), 0x1.fffffep-17 + 0x1.000002p-40 + 3 + static_cast<double>(-0.1F));
}

TEST(ExactSum, CountsEveryDoubleInWholeSteps) {
  const std::uint64_t seed = 72;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int i = 0; i < 10000; ++i) {
    const double value = random.sign() * random.magnitude(-22, 12);
    const double steps = std::nearbyint(value * 0x1p64);
    WideSum sum;
    sum.add(value);
    EXPECT_EQ(sum.units(), static_cast<Int128>(steps)) << value;
  }
}

template <class Sum>
void expect_float_counts_as_double(float value) {
  Sum of_float, of_double;
  of_float.add(value);
  of_double.add(static_cast<double>(value));
  EXPECT_EQ(of_float, of_double) << value;
}

void expect_float_counts_as_double(float value) {
  expect_float_counts_as_double<WideSum>(value);
  expect_float_counts_as_double<SquareSum>(value);
  expect_float_counts_as_double<ShareSum>(value);
}

TEST(ExactSum, CountsAFloatAsTheDoubleThatItIs) {
  const std::uint64_t seed = 73;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (int i = 0; i < 100000; ++i) {
    expect_float_counts_as_double(std::bit_cast<float>(static_cast<std::uint32_t>(random.bits())));
    expect_float_counts_as_double(static_cast<float>(random.sign() * random.magnitude(-22, 20)));
  }
  // Each power of two, the limits among them, and its neighbours.
  for (std::uint32_t exponent = 0; exponent < 256; ++exponent) {
    for (const std::uint32_t fraction : {0U, 1U, 0x7fffffU}) {
      const float value = std::bit_cast<float>(exponent << 23U | fraction);
      expect_float_counts_as_double(value);
      expect_float_counts_as_double(-value);
    }
  }
}

TEST(ExactSum, HoldsAsManyOfTheLargestAsAPixelHasSamples) {
  ShareSum shares;
  WideSum wide;
  for (std::uint32_t i = 0; i < most_samples; ++i) shares.add(infinity), wide.add(-infinity);
  EXPECT_EQ(shares.value(), most_samples * ShareSum::limit());
  EXPECT_EQ(wide.value(), -(most_samples * WideSum::limit()));
  EXPECT_EQ(ShareSum::limit(), 4);
}

TEST(ExactSum, NotANumberCountsAsNothing) {
  WideSum sum;
  sum.add(std::numeric_limits<double>::quiet_NaN());
  sum.add(1.5);
  EXPECT_EQ(sum.value(), 1.5);
}

}  // namespace
}  // namespace tenon
