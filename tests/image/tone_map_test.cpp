#include "tenon/image/tone_map.h"

#include <gtest/gtest.h>

#include <limits>

namespace tenon {
namespace {

TEST(ToneMap, NoneKeepsTheLightAndExposureDoublesIt) {
  EXPECT_EQ(tone_mapped({0.25, 3, 0}, {}), (Rgb{0.25, 3, 0}));
  EXPECT_EQ(tone_mapped({0.25, 3, 0}, {ToneCurve::none, 1}), (Rgb{0.5, 6, 0}));
  EXPECT_EQ(tone_mapped({0.25, 3, 0}, {ToneCurve::none, -2}), (Rgb{0.0625, 0.75, 0}));
}

TEST(ToneMap, ReinhardDividesByTheLuminanceAndKeepsTheHue) {
  const Rgb shown = tone_mapped({1, 1, 1}, {ToneCurve::reinhard, 0});
  EXPECT_NEAR(shown.r, 0.5, 1e-12);
  const Rgb coloured = tone_mapped({8, 4, 2}, {ToneCurve::reinhard, 0});
  EXPECT_NEAR(luminance(coloured), luminance({8, 4, 2}) / (1 + luminance({8, 4, 2})), 1e-12);
  EXPECT_NEAR(coloured.r, 2 * coloured.g, 1e-12);
  EXPECT_NEAR(coloured.g, 2 * coloured.b, 1e-12);
}

TEST(ToneMap, FilmicIsNarkowiczsCurve) {
  // Worked out by hand from the published coefficients.
  EXPECT_NEAR(tone_mapped({1, 1, 1}, {ToneCurve::filmic, 0}).r, 2.54 / 3.16, 1e-12);
  EXPECT_NEAR(tone_mapped({0.18, 0, 0}, {ToneCurve::filmic, 0}).r, 0.18 * 0.4818 / (0.18 * 1.0274 + 0.14), 1e-12);
  EXPECT_EQ(tone_mapped({0, 0, 0}, {ToneCurve::filmic, 0}), Rgb{});
}

TEST(ToneMap, EveryCurveRisesAndStaysFinite) {
  for (const ToneCurve curve : {ToneCurve::none, ToneCurve::reinhard, ToneCurve::filmic}) {
    double before = -1;
    for (double light = 0; light < 1e5; light = 1.3 * light + 0.001) {
      const double shown = tone_mapped({light, light, light}, {curve, 0}).g;
      EXPECT_GE(shown, before) << light;
      before = shown;
    }
    const double infinity = std::numeric_limits<double>::infinity();
    const Rgb brightest = tone_mapped({infinity, infinity, infinity}, {curve, 3});
    EXPECT_TRUE(brightest.r >= 0.99 && brightest.r < infinity);
    EXPECT_EQ(tone_mapped({-1, -1, -1}, {curve, 0}), Rgb{});
  }
}

}  // namespace
}  // namespace tenon
