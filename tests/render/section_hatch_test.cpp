#include "render/section_hatch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scene_builder.h"

namespace tenon {
namespace {

using fixtures::SceneBuilder;

// A cube of 10 that is cut in half at z = 0 and looked at square from above, 20 of it across a picture.
Scene cut_cube() {
  SceneBuilder b;
  Model model;
  model.graph = b.finish(b.cube({20, 20, 20}, true));
  model.section = {{{{{0, 0, 1}, 0}}}};
  Camera camera;
  camera.from = {0, 0, 50};
  camera.at = {0, 0, 0};
  camera.up = {0, 1, 0};
  camera.projection = Projection::orthographic;
  camera.width = 20;
  model.camera = camera;
  Diagnostics diagnostics;
  return std::move(compile_scene(std::move(model), diagnostics)).value();
}

class SectionHatchTest : public testing::Test {
 protected:
  static constexpr int pixels = 200;

  // The light of the cut face at a place.
  double light(const HatchOptions& options, double x, double y, int samples = 1) {
    const SectionHatch hatch(scene_, *camera_, options, samples);
    return hatch.light(tracer_.first_hit(camera_->ray(x, y)), {x, y});
  }
  double mean(const HatchOptions& options) {
    double sum = 0;
    for (int x = 0; x < pixels; x += 3) {
      for (int y = 0; y < pixels; y += 3) sum += light(options, x + 0.5, y + 0.5);
    }
    return sum / (67.0 * 67);
  }

  Scene scene_ = cut_cube();
  Result<CameraRays> camera_ = CameraRays::create(scene_.camera, pixels, pixels);
  fixtures::Tracer tracer_{*scene_.tree};
};

TEST_F(SectionHatchTest, LinesRepeatAtTheirSpacingAcrossTheirAngleAndNotAlongIt) {
  // 10 pixels are one unit.
  for (const bool in_pixels : {false, true}) {
    for (const double angle : {0.0, 30.0, 45.0, 90.0, 120.0}) {
      const HatchOptions options{angle, in_pixels ? 20.0 : 2.0, in_pixels};
      const double a = angle * std::acos(-1.0) / 180;
      const double along_x = std::cos(a), along_y = -std::sin(a);  // y grows downward
      double least = 1, most = 0;
      for (int i = 0; i < 40; ++i) {
        const double x = 100 + 0.5 * i * -along_y, y = 100 + 0.5 * i * along_x;
        const double here = light(options, x, y);
        least = std::min(least, here);
        most = std::max(most, here);
        EXPECT_NEAR(light(options, x + 33 * along_x, y + 33 * along_y), here, 1e-6) << "along a line";
        EXPECT_NEAR(light(options, x + 20 * -along_y, y + 20 * along_x), here, 1e-6) << "a spacing on";
      }
      EXPECT_LT(least, 0.6) << angle;
      EXPECT_EQ(most, 1) << angle;
    }
  }
}

TEST_F(SectionHatchTest, TakesTheSameShareOfLightAtAnySpacing) {
  const double coarse = mean({45, 3, false});
  EXPECT_NEAR(coarse, 0.92, 0.02);
  for (const double spacing : {1.0, 0.2, 0.1, 0.01, 1e-5})
    EXPECT_NEAR(mean({45, spacing, false}), coarse, 0.01) << spacing;
}

TEST_F(SectionHatchTest, FineLinesAreGreyNotMoire) {
  const double grey = light({30, 0.003, false}, 50, 50);
  for (int i = 0; i < 50; ++i) EXPECT_NEAR(light({30, 0.003, false}, 50 + 1.37 * i, 50 + 0.71 * i), grey, 0.02);
}

TEST_F(SectionHatchTest, LiesOnCutFacesAlone) {
  const SectionHatch hatch(scene_, *camera_, {}, 1);
  const Hit side = tracer_.first_hit({{50, 0, -5}, {-1, 0, 0}});
  ASSERT_TRUE(side.found());
  EXPECT_EQ(hatch.light(side, {50, 50}), 1);
  EXPECT_EQ(hatch.light(Hit{}, {50, 50}), 1);
}

}  // namespace
}  // namespace tenon
