#include "image/display_levels.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tenon/math/color.h"

namespace tenon {
namespace {

long level(float light) {
  return std::lround(255 * srgb_from_linear(static_cast<double>(light)));
}

float from_bits(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}

TEST(DisplayLevels, AreTheRoundedEncoding) {
  const DisplayLevels& levels = DisplayLevels::instance();
  constexpr std::uint32_t one = std::bit_cast<std::uint32_t>(1.0F);
  for (std::uint32_t bits = 0; bits < one + 1000; bits += 997) {
    ASSERT_EQ(levels.of(from_bits(bits)), level(from_bits(bits))) << from_bits(bits);
  }
}

TEST(DisplayLevels, StepWhereTheEncodingDoes) {
  const DisplayLevels& levels = DisplayLevels::instance();
  for (long step = 1; step <= 255; ++step) {
    std::uint32_t below = 0, above = std::bit_cast<std::uint32_t>(1.0F);
    while (above - below > 1) {
      const std::uint32_t middle = below + (above - below) / 2;
      (level(from_bits(middle)) < step ? below : above) = middle;
    }
    EXPECT_EQ(levels.of(from_bits(below)), step - 1);
    EXPECT_EQ(levels.of(from_bits(above)), step);
  }
}

TEST(DisplayLevels, OfLightThatIsNone) {
  const DisplayLevels& levels = DisplayLevels::instance();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(levels.of(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(levels.of(-infinity), 0);
  EXPECT_EQ(levels.of(-0.5F), 0);
  EXPECT_EQ(levels.of(-0.0F), 0);
  EXPECT_EQ(levels.of(1), 255);
  EXPECT_EQ(levels.of(2), 255);
  EXPECT_EQ(levels.of(infinity), 255);
}

}  // namespace
}  // namespace tenon
