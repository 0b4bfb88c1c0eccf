#include <gtest/gtest.h>

#include <cmath>

#include "support/scene_builder.h"
#include "tenon/render/renderer.h"

// What a camera makes of a scene that is traced by a structure: through a lens, and from inside of solids.
namespace tenon {
namespace {

using fixtures::SceneBuilder;

Material matt(const Rgba& tint) {
  Material m;
  m.model = MaterialModel::phong;
  m.kd = 1;
  m.ks = 0;
  m.color = tint;
  return m;
}

Film picture(Model model, RenderOptions options) {
  Diagnostics diagnostics;
  const Result<Scene> scene = compile_scene(std::move(model), diagnostics);
  EXPECT_TRUE(scene.ok());
  const auto accelerator = build_accelerator("cells", *scene->tree);
  options.threads = 1;
  Result<Rendering> rendering = render(*scene, **accelerator, options);
  EXPECT_TRUE(rendering.ok());
  return std::move(rendering->film);
}

class CameraPicture : public testing::TestWithParam<IntegratorKind> {
 protected:
  RenderOptions options(int width, int height, std::uint32_t samples) const {
    RenderOptions o;
    o.width = width;
    o.height = height;
    o.samples = samples;
    o.integrator = GetParam();
    o.depth = 2;
    return o;
  }
};

// A ball much smaller than the circle of confusion is seen as the lens: a disc of the circle's diameter, evenly lit.
TEST_P(CameraPicture, WhatIsOutOfFocusIsSpreadOverTheCircleOfConfusion) {
  constexpr int pixels = 80;
  constexpr double aperture = 2, focus = 40;
  for (const double distance : {20.0, 40.0, 120.0}) {
    SceneBuilder b;
    Model model;
    const double radius = 0.002 * distance;
    model.graph = b.finish(b.material(0, b.translate({0, distance, 0}, b.sphere(radius))));
    model.materials = {matt({1, 1, 1, 1})};
    model.background = Rgba{0, 0, 0, 1};
    model.ambient = Rgba{1, 1, 1, 1};
    Light none;
    none.intensity = 0;
    model.lights = {none};
    Camera camera;
    camera.from = {0, 0, 0};
    camera.at = {0, 1, 0};
    camera.fov = 10;
    camera.aperture = aperture;
    camera.focus = focus;
    model.camera = camera;
    const Film film = picture(std::move(model), options(pixels, pixels, 256));
    // A pixel at distance 1; the mean square of what the disc, the ball and a pixel each add.
    const double pixel = 2 * std::tan(5 * std::acos(-1.0) / 180) / pixels;
    const double circle = aperture * std::fabs(distance - focus) / (focus * distance), ball = radius / distance;
    double light = 0, spread = 0;
    for (int y = 0; y < pixels; ++y) {
      for (int x = 0; x < pixels; ++x) {
        const double l = film.light(x, y).g;
        light += l;
        spread += l * (std::pow(x + 0.5 - pixels / 2.0, 2) + std::pow(y + 0.5 - pixels / 2.0, 2)) * pixel * pixel;
      }
    }
    ASSERT_GT(light, 0);
    const double expected = circle * circle / 8 + ball * ball / 2 + pixel * pixel / 6;
    EXPECT_NEAR(std::sqrt(spread / light), std::sqrt(expected), 0.04 * std::sqrt(expected) + 0.1 * pixel) << distance;
    // As much light as the ball sends without a lens: its share of the picture.
    EXPECT_NEAR(light * pixel * pixel / (std::acos(-1.0) * ball * ball), 1, 0.15) << distance;
  }
}

// From inside of a solid its boundary is seen, from within and lit by what stands there, in the material it has.
TEST_P(CameraPicture, FromInsideOfASolidItsWallsAreSeen) {
  SceneBuilder b;
  Model model;
  const SceneNodeId room = b.material(0, b.cube({8, 8, 8}, true));
  model.graph = b.finish(b.unite({room, b.material(1, b.translate({40, 0, 0}, b.sphere(1)))}));
  model.materials = {matt({1, 0, 0, 1}), matt({0, 0, 1, 1})};
  model.background = Rgba{0, 1, 0, 1};
  model.ambient = Rgba{0, 0, 0, 1};
  Light lamp;
  lamp.position = {0, 0, 0};
  model.lights = {lamp};
  Camera camera;
  camera.from = {-2, -2, -1};
  camera.at = {4, 1, 0.5};
  camera.fov = 100;
  model.camera = camera;
  RenderOptions few = options(24, 16, 4);
  few.depth = 1;
  const Film film = picture(std::move(model), few);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 24; ++x) {
      EXPECT_GT(film.light(x, y).r, 0.1) << "a wall that the lamp inside lights, at " << x << ", " << y;
      EXPECT_EQ(film.light(x, y).g, 0);
      EXPECT_EQ(film.light(x, y).b, 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, CameraPicture, testing::Values(IntegratorKind::whitted, IntegratorKind::path),
                         [](const auto& test) { return test.param == IntegratorKind::path ? "path" : "whitted"; });

}  // namespace
}  // namespace tenon
