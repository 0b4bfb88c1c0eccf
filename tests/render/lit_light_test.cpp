#include "render/lit_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tenon {
namespace {

constexpr double pi = std::numbers::pi;

// The irradiance of a small surface, by drawing from the light.
double irradiance(const LitLight& light, const Vec3& point, const Vec3& normal) {
  constexpr std::uint32_t n = 1 << 14;
  double sum = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    LightSample sample;
    if (light.draw(point, Sampler(1)({0, 0, i}, 0), sample))
      sum += sample.light.g * std::max(0.0, dot(normalize(sample.to_light), normal));
  }
  return sum / n;
}

// A direction that is drawn and one that is met have one density.
void expect_one_density(const LitLight& light, const Vec3& point) {
  for (std::uint32_t i = 0; i < 100; ++i) {
    LightSample sample;
    ASSERT_TRUE(light.draw(point, Sampler(2)({0, 0, i}, 0), sample));
    const auto met = light.intersect({point, normalize(sample.to_light)});
    ASSERT_TRUE(met) << i;
    EXPECT_NEAR(met->t, length(sample.to_light), 1e-7 * met->t);
    EXPECT_NEAR(met->density, sample.density, 1e-6 * sample.density);
    EXPECT_NEAR(met->cos, sample.cos, 1e-5);
  }
}

TEST(LitLight, SphereSendsTheLightOfItsSolidAngle) {
  Light l;
  l.kind = LightKind::sphere;
  l.position = {1, 2, 5};
  l.radius = 1.5;
  l.intensity = 3;
  const LitLight light(l);
  const Vec3 point{0, 0, 0}, normal{0, 0, 1};
  // A sphere wholly above the horizon: pi L (R / d)^2 cos.
  const double d2 = 30, cos = 5 / std::sqrt(d2);
  EXPECT_NEAR(irradiance(light, point, normal), pi * 3 * 1.5 * 1.5 / d2 * cos, 2e-4);
  expect_one_density(light, point);
  LightSample none;
  EXPECT_FALSE(light.draw({1, 2, 4.5}, {0.5, 0.5}, none)) << "a point inside sees nothing of it";
}

TEST(LitLight, RectangleSendsTheLightOfItsContour) {
  Light l;
  l.kind = LightKind::rectangle;
  l.position = {0.5, 0, 2};
  l.edge_u = {3, 0, 0};
  l.edge_v = {0, 2, 0};
  l.intensity = 2;
  const LitLight light(l);
  const Vec3 point{0, 0, 0}, normal{0, 0, 1};
  // Lambert's formula of the contour.
  const Vec3 corners[] = {{-1, -1, 2}, {2, -1, 2}, {2, 1, 2}, {-1, 1, 2}};
  Vec3 sum;
  for (int i = 0; i < 4; ++i) {
    const Vec3 a = normalize(corners[i]), b = normalize(corners[(i + 1) % 4]);
    sum += std::acos(dot(a, b)) * normalize(cross(a, b));
  }
  EXPECT_NEAR(irradiance(light, point, normal), 2 * std::fabs(sum.z) / 2, 5e-4);
  expect_one_density(light, point);
  LightSample none;
  EXPECT_FALSE(light.draw({0, 0, 3}, {0.5, 0.5}, none)) << "from behind it is not there";
  EXPECT_FALSE(light.intersect({{0.5, 0, 3}, {0, 0, -1}}));
}

TEST(LitLight, FadesFromItsDistanceByTheSquare) {
  Light l;
  l.position = {0, 0, 3};
  l.fade_distance = 6;
  EXPECT_NEAR(LitLight(l).at({0, 0, 0}).light.r, 4, 1e-12);
  l.fade_distance = 0;
  EXPECT_EQ(LitLight(l).at({0, 0, 0}).light.r, 1);
}

LightMap small_map() {
  LightMap map{8, 4, {}};
  for (int i = 0; i < 32; ++i) {
    for (int band = 0; band < 3; ++band) map.rgb.push_back(i == 12 ? 50.0F : 0.1F * static_cast<float>(i % 5));
  }
  return map;
}

TEST(Environment, DensitiesAddUpAndMatchWhatIsDrawn) {
  Light l;
  l.kind = LightKind::environment;
  l.turn = 30;
  l.map = std::make_shared<const LightMap>(small_map());
  const Environment environment(l);
  constexpr int n = 400;
  double density = 0, light = 0;
  for (int i = 0; i < n; ++i) {
    const double theta = pi * (i + 0.5) / n;
    for (int j = 0; j < 2 * n; ++j) {
      const double phi = pi * (j + 0.5) / n;
      const Vec3 d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
      const double cell = std::sin(theta) * (pi / n) * (pi / n);
      density += cell * environment.density(d);
      light += cell * environment.radiance(d).g;
      EXPECT_TRUE(environment.radiance(d).g == 0 || environment.density(d) > 0);
    }
  }
  EXPECT_NEAR(density, 1, 1e-3);
  double drawn = 0;
  constexpr std::uint32_t draws = 1 << 14;
  for (std::uint32_t i = 0; i < draws; ++i) {
    const auto sample = environment.sample(Sampler(1)({0, 0, i}, 0));
    ASSERT_TRUE(sample);
    EXPECT_NEAR(sample->density, environment.density(sample->direction), 1e-9 * sample->density);
    drawn += sample->radiance.g / sample->density / draws;
  }
  EXPECT_NEAR(drawn, light, 5e-3 * light);
}

TEST(Environment, MiddleOfThePictureLiesAlongY) {
  Light l;
  l.kind = LightKind::environment;
  LightMap map{4, 2, std::vector<float>(24, 0.0F)};
  map.rgb[3 * 2] = map.rgb[3 * 1] = 1;  // the upper two pixels that meet in the middle
  l.map = std::make_shared<const LightMap>(map);
  const Vec3 ahead = normalize({0, 1, 0.5});
  EXPECT_GT(Environment(l).radiance(ahead).r, 0.6);
  EXPECT_EQ(Environment(l).radiance(-ahead).r, 0);
  l.turn = 90;  // counterclockwise: what lay along y lies along -x
  EXPECT_GT(Environment(l).radiance(normalize({-1, 0, 0.5})).r, 0.6);
  EXPECT_LT(Environment(l).radiance(normalize({1, 0, 0.5})).r, 0.1);
}

TEST(Sky, ShowsItsIntensityOnWhiteGroundAndIsBrightestAtTheSun) {
  Light l;
  l.kind = LightKind::sky;
  l.direction = {0.3, -0.4, -0.6};
  l.intensity = 0.7;
  const Environment sky(l);
  constexpr int n = 200;
  Rgb sum;
  double brightest = 0;
  Vec3 where;
  for (int i = 0; i < n; ++i) {
    const double theta = pi / 2 * (i + 0.5) / n;
    for (int j = 0; j < 2 * n; ++j) {
      const double phi = pi * (j + 0.5) / n;
      const Vec3 d{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
      const Rgb there = sky.radiance(d);
      sum += (std::sin(theta) * std::cos(theta) * (pi / 2 / n) * (pi / n) / pi) * there;
      if (there.g > brightest) brightest = there.g, where = d;
    }
  }
  EXPECT_NEAR(0.2126 * sum.r + 0.7152 * sum.g + 0.0722 * sum.b, 0.7, 0.01);
  EXPECT_GT(dot(where, normalize(-l.direction)), 0.99);
  EXPECT_GT(sky.radiance({0, 0, 1}).b, sky.radiance({0, 0, 1}).r) << "the zenith is blue";
}

TEST(LitLight, SendsToManyPointsWhatItSendsToEach) {
  Light l;
  l.position = {1, 2, 5};
  l.direction = {0, 0, -1};
  l.angle = 40;
  l.softness = 0.5;
  l.radius = 0.5;
  l.edge_u = {3, 0, 0};
  l.edge_v = {0, 2, 0};
  l.color = {0.2, 0.5, 0.7};
  for (const LightKind kind : {LightKind::point, LightKind::directional, LightKind::spot, LightKind::sphere,
                               LightKind::rectangle, LightKind::sky}) {
    for (const double fade_distance : {0.0, 3.0}) {
      l.kind = kind;
      l.fade_distance = fade_distance;
      const LitLight light(l);
      Vec3Block points;
      constexpr std::size_t count = block_size - 3;
      // From under the light to far beside it, and some above.
      for (std::size_t i = 0; i < count; ++i) points.set(i, {0.2 * static_cast<double>(i), 1, i % 7 == 0 ? 6.0 : 0.0});
      IncidentLightBlock block;
      light.at(points, count, block);
      for (std::size_t i = 0; i < count; ++i) {
        const IncidentLight one = light.at(points[i]);
        EXPECT_EQ(block.to_light[i], one.to_light);
        EXPECT_EQ(block.t_max[i], one.t_max);
        EXPECT_EQ(block.light[i], one.light);
      }
    }
  }
}

}  // namespace
}  // namespace tenon
