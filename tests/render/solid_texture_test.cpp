#include "render/solid_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/lit_scene.h"
#include "support/random.h"
#include "tenon/accel/accelerator.h"
#include "tenon/lang/load.h"

namespace tenon {
namespace {

TEST(SolidTexture, CheckerChangesFromCubeToCube) {
  SolidTexture t;
  t.kind = TextureKind::checker;
  t.size = 2;
  EXPECT_EQ(second_share(t, {0.1, 0.1, 0.1}), 0);
  EXPECT_EQ(second_share(t, {2.1, 0.1, 0.1}), 1);
  EXPECT_EQ(second_share(t, {2.1, 2.1, 0.1}), 0);
  EXPECT_EQ(second_share(t, {-1.9, 2.1, 2.1}), 1);
  EXPECT_EQ(second_share(t, {0.9, 0, 0}), second_share(t, {-0.9, 0, 0})) << "one cube around the origin";
}

TEST(SolidTexture, MovesWithItsFrame) {
  for (const TextureKind kind : {TextureKind::checker, TextureKind::marble, TextureKind::wood, TextureKind::noise}) {
    SolidTexture here, there;
    here.kind = there.kind = kind;
    const Affine3 move = Affine3::translate({3, -7, 2}) * Affine3::rotate({10, 50, 70});
    there.texture_from_world = *move.inverse();
    for (double x : {0.13, 0.77, 1.41}) {
      const Vec3 p{x, 2 * x - 1, 0.3 - x};
      EXPECT_NEAR(second_share(here, p), second_share(there, move.point(p)), 1e-12);
    }
  }
}

// The cube's faces lie two and a half cubes of the pattern from its middle: where cubes meet.
TEST(SolidTexture, AFaceWhereCubesOfThePatternMeetShowsWhatLiesUnderIt) {
  Diagnostics diagnostics;
  Result<Model> model = load_model_text(R"(
    translate([7, -2, 5]) rotate([10, 20, 30])
      material(model = "lambert", color = [1, 1, 1], texture = "checker", texture_color = [0, 0, 0], texture_size = 0.4)
        difference() { cube(2, center = true); translate([-1, -1, 0.6]) cube(2); })",
                                        "test.scad", {}, diagnostics);
  ASSERT_TRUE(model.ok());
  const Result<Scene> scene = compile_scene(std::move(*model), diagnostics);
  ASSERT_TRUE(scene.ok());
  const LitScene lit(*scene);
  const SolidTexture& texture = scene->materials.front().texture;
  const auto accelerator = build_accelerator("cells", *scene->tree);
  const auto context = (*accelerator)->make_context();
  const std::uint64_t seed = 5;
  SCOPED_TRACE(seed);
  Random random(seed);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    RayQuery query;
    query.ray = {Vec3{7, -2, 5} + 5.0 * random.direction(), {}};
    query.ray.direction = normalize(Vec3{7, -2, 5} + random.direction() - query.ray.origin);
    const Hit hit = (*accelerator)->first_hit(query, *context);
    const Vec3 under = hit.point - 1e-9 * hit.normal, deeper = hit.point - 0.01 * hit.normal;
    // Not where cubes meet across the face.
    if (!hit.found() || second_share(texture, under) != second_share(texture, deeper)) continue;
    ++met;
    EXPECT_EQ(lit.color(hit).r, 1 - second_share(texture, deeper));
  }
  EXPECT_GT(met, 1000);
}

TEST(GradientNoise, IsZeroAtWholeCoordinatesAndSmoothBetween) {
  double least = 1, most = -1;
  for (int i = -20; i < 20; ++i) {
    EXPECT_EQ(gradient_noise({1.0 * i, 2.0 * i, 7.0 - i}), 0);
    for (double f = 0; f < 1; f += 0.01) {
      const Vec3 p{i + f, 0.37 * i + 0.3, 0.61};
      const double here = gradient_noise(p);
      least = std::min(least, here);
      most = std::max(most, here);
      EXPECT_NEAR(gradient_noise(p + Vec3{1e-7, 0, 0}), here, 1e-6);
    }
  }
  EXPECT_LT(least, -0.3);
  EXPECT_GT(most, 0.3);
  EXPECT_GE(least, -1.5);
  EXPECT_LE(most, 1.5);
}

}  // namespace
}  // namespace tenon
