#include "tenon/image/heat_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "image/viridis.h"
#include "tenon/math/color.h"

namespace tenon {
namespace {

std::uint32_t color_of(const HeatMapPicture& picture, int x, int y) {
  std::uint32_t color = 0;
  for (int c = 0; c < 3; ++c) {
    const double light = picture.rgb[static_cast<std::size_t>(3 * (y * picture.width + x) + c)];
    color = color << 8 | static_cast<std::uint32_t>(std::lround(255 * srgb_from_linear(light)));
  }
  return color;
}

int dark_pixels_below(const HeatMapPicture& picture, int y0) {
  int count = 0;
  for (int y = y0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) count += color_of(picture, x, y) == 0 ? 1 : 0;
  }
  return count;
}

TEST(HeatMap, LinearColoursRunFromZeroToTheLargest) {
  const std::vector<double> values{0, 5, 10, 2.5};
  const HeatMapPicture picture = draw_heat_map({4, 1, values, "title", HeatScale::linear, 0});
  EXPECT_EQ(color_of(picture, 0, 0), viridis.front());
  EXPECT_EQ(color_of(picture, 2, 0), viridis.back());
  EXPECT_EQ(color_of(picture, 1, 0), viridis[128]);
  EXPECT_EQ(color_of(picture, 3, 0), viridis[64]);
}

TEST(HeatMap, LogarithmicColoursGoByFactors) {
  const std::vector<double> values{0, 1, 10, 100};
  const HeatMapPicture picture = draw_heat_map({4, 1, values, "", HeatScale::logarithmic, 0});
  EXPECT_EQ(color_of(picture, 0, 0), viridis.front());
  EXPECT_EQ(color_of(picture, 1, 0), viridis.front());
  EXPECT_EQ(color_of(picture, 2, 0), viridis[128]);
  EXPECT_EQ(color_of(picture, 3, 0), viridis.back());
}

TEST(HeatMap, AutomaticIsLogarithmicWhereFewPixelsCostMost) {
  std::vector<double> values(100, 1.0);
  values[7] = 29;
  EXPECT_EQ(draw_heat_map({10, 10, values, "", HeatScale::automatic, 0}).rgb,
            draw_heat_map({10, 10, values, "", HeatScale::linear, 0}).rgb);
  values[7] = 31;
  EXPECT_EQ(draw_heat_map({10, 10, values, "", HeatScale::automatic, 0}).rgb,
            draw_heat_map({10, 10, values, "", HeatScale::logarithmic, 0}).rgb);
}

TEST(HeatMap, GivenLargestMakesPicturesComparable) {
  const std::vector<double> low{1, 2, 3, 4}, high{4, 8, 30, 50};
  const HeatMapPicture a = draw_heat_map({4, 1, low, "", HeatScale::linear, 40});
  const HeatMapPicture b = draw_heat_map({4, 1, high, "", HeatScale::linear, 40});
  EXPECT_EQ(color_of(a, 3, 0), color_of(b, 0, 0));
  EXPECT_EQ(color_of(b, 3, 0), viridis.back());  // above it
}

TEST(HeatMap, LegendStandsUnderThePictureWithNumbersAndWords) {
  const std::vector<double> values(400 * 3, 7.0);
  const HeatMapPicture bare = draw_heat_map({400, 3, values, "", HeatScale::linear, 0});
  const HeatMapPicture titled = draw_heat_map({400, 3, values, "tests a pixel", HeatScale::linear, 0});
  EXPECT_EQ(bare.width, 400);
  EXPECT_GT(bare.height, 3 + 40);
  EXPECT_GT(dark_pixels_below(bare, 3), 100);
  EXPECT_GT(dark_pixels_below(titled, 3), dark_pixels_below(bare, 3) + 50);
}

TEST(HeatMap, NarrowOrEmptyOfCostIsDrawnAllTheSame) {
  const std::vector<double> nothing(4, 0.0);
  for (const HeatScale scale : {HeatScale::automatic, HeatScale::linear, HeatScale::logarithmic}) {
    const HeatMapPicture picture = draw_heat_map({2, 2, nothing, "nothing", scale, 0});
    EXPECT_GE(picture.width, 320);
    EXPECT_EQ(color_of(picture, 1, 1), viridis.front());
    EXPECT_EQ(color_of(picture, 2, 0), 0xffffffU);
    for (const float v : picture.rgb) ASSERT_TRUE(v >= 0 && v <= 1);
  }
}

}  // namespace
}  // namespace tenon
