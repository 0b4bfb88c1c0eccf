#include "render/ambient_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "render/environment.h"
#include "support/random.h"

namespace tenon {
namespace {

// The irradiance over pi by its definition, on a grid of directions.
Rgb shown_by_definition(const Environment& around, const Vec3& normal) {
  constexpr int rows = 200;
  Rgb sum;
  for (int row = 0; row < rows; ++row) {
    const double colatitude = std::numbers::pi * (row + 0.5) / rows;
    for (int column = 0; column < 2 * rows; ++column) {
      const double longitude = std::numbers::pi * (column + 0.5) / rows;
      const Vec3 d{std::sin(colatitude) * std::cos(longitude), std::sin(colatitude) * std::sin(longitude),
                   std::cos(colatitude)};
      const double cell = std::sin(colatitude) * std::numbers::pi / rows * std::numbers::pi / rows;
      sum += (std::max(0.0, dot(d, normal)) * cell / std::numbers::pi) * around.radiance(d);
    }
  }
  return sum;
}

void expect_near(const Rgb& a, const Rgb& b, double near) {
  EXPECT_NEAR(a.r, b.r, near);
  EXPECT_NEAR(a.g, b.g, near);
  EXPECT_NEAR(a.b, b.b, near);
}

TEST(AmbientLight, OfAUniformWorldIsItsColour) {
  Light light;
  light.kind = LightKind::environment;
  light.color = {1, 0.5, 0, 1};
  const Environment around(light);
  expect_near(AmbientLight(around)({0.6, 0, -0.8}), around.radiance({1, 0, 0}), 0);
}

TEST(AmbientLight, OfASkyIsItsIrradiance) {
  Light light;
  light.kind = LightKind::sky;
  light.direction = {1, 0.5, -1};
  light.intensity = 2;
  const Environment around(light);
  const AmbientLight ambient(around);
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const Vec3 normal = normalize({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    // What the harmonics leave out of half a sphere of light is 3 % of it.
    expect_near(ambient(normal), shown_by_definition(around, normal), 0.06);
  }
}

// What a small lamp sends is hard to hit, and easy to draw: cos on its side, as good as nothing on the other.
TEST(AmbientLight, OfOneBrightPixelFollowsTheCosine) {
  auto map = std::make_shared<LightMap>();
  map->width = 128;
  map->height = 64;
  map->rgb.assign(3 * 128 * 64, 0.0F);
  const std::size_t pixel = 32 * 128 + 64;  // its middle lies along +y, at the horizon
  for (std::size_t c = 0; c < 3; ++c) map->rgb[3 * pixel + c] = 1000;
  Light light;
  light.kind = LightKind::environment;
  light.map = map;
  const Environment around(light);
  const AmbientLight ambient(around);
  const double straight = 1000 * (2 * std::numbers::pi / 128) * (std::numbers::pi / 64) / std::numbers::pi;
  // The clamped cosine in harmonics of the second order: 17/16 in the middle, 1/16 behind, never off by more than 3/32.
  for (const double degrees : {0.0, 40.0, 80.0, 120.0, 180.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Rgb shown = ambient({0, std::cos(angle), std::sin(angle)});
    EXPECT_NEAR(shown.g, std::max(0.0, std::cos(angle)) * straight, 0.11 * straight) << degrees;
  }
}

}  // namespace
}  // namespace tenon
