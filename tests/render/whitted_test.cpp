#include "render/whitted.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/analytic_accelerator.h"
#include "support/random.h"
#include "tenon/render/renderer.h"

namespace tenon {
namespace {

constexpr double tight = 1e-14;  // a few dozen roundings of numbers near 1

// White, matt, opaque; the tests change what they are about.
Material matt() {
  Material m;
  m.model = MaterialModel::whitted;
  m.kd = 1;
  m.ks = 0;
  m.kt = 0;
  m.color = Rgba{1, 1, 1, 1};
  return m;
}

Material mirror(double ks) {
  Material m = matt();
  m.kd = 0;
  m.ks = ks;
  m.shininess = 1e9;  // no highlight but in the very direction
  return m;
}

Material glass(double kt, double ior) {
  Material m = matt();
  m.kd = 0;
  m.kt = kt;
  m.ior = ior;
  return m;
}

Light point_light(const Vec3& position) {
  Light light;
  light.position = position;
  return light;
}

class Whitted : public testing::Test {
 protected:
  void add(std::variant<AnalyticBall, AnalyticSlab> shape, const Material& material) {
    AnalyticSolid solid{shape, MaterialId{scene.materials.size()}, medium_opaque};
    scene.materials.push_back(material);
    if (material.kt > 0) {
      solid.medium = static_cast<MediumId>(scene.media.size());
      scene.media.push_back({material.ior, {}});
    }
    solids.push_back(solid);
  }

  std::vector<Rgb> radiance(const std::vector<RayQuery>& queries, std::size_t at_once, const RecursionLimits& limits) {
    AnalyticAccelerator accelerator(solids);
    if (reversed) accelerator.reverse_shadow_order();
    const auto context = accelerator.make_context();
    const LitScene lit(scene);
    WhittedIntegrator integrator(lit, accelerator, limits);
    std::vector<Hit> hits(queries.size());
    accelerator.first_hits(queries, hits, *context);
    const std::vector<SampleId> samples(queries.size());
    std::vector<Rgb> light(queries.size());
    for (std::size_t i = 0; i < queries.size(); i += at_once) {
      const std::size_t n = std::min(at_once, queries.size() - i);
      integrator.radiance(std::span(queries).subspan(i, n), std::span(hits).subspan(i, n),
                          std::span(samples).subspan(i, n), std::span(light).subspan(i, n), *context);
    }
    statistics = context->statistics;
    return light;
  }

  Rgb radiance(const Vec3& origin, const Vec3& direction, const RecursionLimits& limits = {20, 0}) {
    RayQuery query;
    query.ray = {origin, normalize(direction)};
    return radiance({query}, 1, limits).front();
  }

  Scene scene;
  std::vector<AnalyticSolid> solids;
  TraversalStatistics statistics;
  bool reversed = false;
};

TEST_F(Whitted, BackgroundWhereNothingIsMet) {
  scene.background = {0.25, 0.5, 0.75};
  EXPECT_EQ(radiance({0, 0, 5}, {0, 0, 1}), scene.background);
}

TEST_F(Whitted, AmbientAloneIsKdTimesColourTimesAmbient) {
  Material m = matt();
  m.kd = 0.5;
  m.color = Rgba{1, 0, 1, 1};
  add(AnalyticBall{{0, 0, 0}, 1}, m);
  scene.ambient = {0.5, 0.5, 0.25};
  EXPECT_EQ(radiance({0, 0, 5}, {0, 0, -1}), (Rgb{0.25, 0, 0.125}));
  scene.materials[0].ka = 1;
  EXPECT_EQ(radiance({0, 0, 5}, {0, 0, -1}), (Rgb{0.5, 0, 0.25}));
}

TEST_F(Whitted, LightAtTheEyeShowsTheCosine) {
  add(AnalyticBall{{0, 0, 0}, 1}, matt());
  const Vec3 eye{0, 0, 5};
  scene.lights = {point_light(eye)};
  for (double degrees : {0.0, 2.0, 5.0, 9.0, 11.0}) {
    const double a = degrees * std::numbers::pi / 180;
    // Sine rule in the triangle of eye, centre and point: sin(incidence) = 5 sin(a).
    const double incidence = std::asin(5 * std::sin(a));
    EXPECT_NEAR(radiance(eye, {std::sin(a), 0, -std::cos(a)}).r, std::cos(incidence), 100 * tight);
  }
}

TEST_F(Whitted, DirectionalLightNeedsNoPlace) {
  add(AnalyticSlab{-1, 0}, matt());
  Light sun;
  sun.kind = LightKind::directional;
  sun.direction = {3, 0, -4};
  sun.intensity = 2;
  scene.lights = {sun};
  EXPECT_NEAR(radiance({0, 0, 5}, {0, 0, -1}).g, 2 * 0.8, tight);
}

TEST_F(Whitted, HighlightFollowsTheHalfVectorAndKeepsTheLightsColour) {
  Material m = matt();
  m.model = MaterialModel::phong;
  m.kd = 0;
  m.ks = 0.5;
  m.shininess = 10;
  m.color = Rgba{1, 0, 0, 1};
  add(AnalyticSlab{-1, 0}, m);
  // Light 60 degrees from the normal, eye along the normal: the half vector is 30 degrees off.
  scene.lights = {point_light({10 * std::sqrt(3.0), 0, 10})};
  const double expected = 0.5 * std::pow(std::cos(std::numbers::pi / 6), 10);
  const Rgb light = radiance({0, 0, 5}, {0, 0, -1});
  EXPECT_NEAR(light.r, expected, 100 * tight);
  EXPECT_NEAR(light.b, expected, 100 * tight);
}

TEST_F(Whitted, InsideOfAnOpaqueSolidIsLitByTheAmbientLightAlone) {
  add(AnalyticBall{{0, 0, 0}, 1}, matt());
  scene.ambient = {0.3, 0.3, 0.3};
  scene.lights = {point_light({0, 0, 5})};
  EXPECT_EQ(radiance({0, 0, 0}, {0, 0, 1}), scene.ambient);
  EXPECT_EQ(radiance({0, 0, 0}, {0, 0, -1}), scene.ambient);
}

TEST_F(Whitted, SpotEndsAtItsCone) {
  add(AnalyticSlab{-1, 0}, matt());
  Light spot;
  spot.kind = LightKind::spot;
  spot.position = {0, 0, 1};
  spot.direction = {0, 0, -3};
  spot.angle = 45;
  spot.softness = 0;
  scene.lights = {spot};
  const auto at = [&](double x) { return radiance({x, 0, 5}, {0, 0, -1}).r; };
  EXPECT_EQ(at(0), 1);
  EXPECT_NEAR(at(0.999), 1 / std::sqrt(1 + 0.999 * 0.999), tight);
  EXPECT_EQ(at(1.001), 0);

  scene.lights[0].softness = 0.5;
  const double rim = std::tan(33.75 * std::numbers::pi / 180);  // half way through the fading angle
  EXPECT_EQ(at(1.001), 0);
  EXPECT_NEAR(at(0.4), 1 / std::sqrt(1.16), tight);
  EXPECT_GT(at(rim), 0.2);
  EXPECT_LT(at(rim), std::cos(33.75 * std::numbers::pi / 180) - 0.2);
}

TEST_F(Whitted, OpaqueSolidsCastShadowsAndThoseBehindTheLightDoNot) {
  add(AnalyticSlab{-1, 0}, matt());
  add(AnalyticBall{{0, 0, 2}, 0.5}, matt());
  scene.lights = {point_light({0, 0, 4})};
  EXPECT_EQ(radiance({1, 0, 1}, {-1, 0, -1}).r, 0);
  scene.lights = {point_light({0, 0, 1})};
  EXPECT_NEAR(radiance({1, 0, 1}, {-1, 0, -1}).r, 1, tight);
}

TEST_F(Whitted, TransparentSolidsAttenuateByKtAtEachBoundary) {
  add(AnalyticSlab{-1, 0}, matt());
  add(AnalyticSlab{1, 2}, glass(0.7, 1.5));
  scene.lights = {point_light({0, 0, 4})};
  EXPECT_NEAR(radiance({0.5, 0, 0.5}, {-1, 0, -1}).r, 0.7 * 0.7, tight);

  // Seen by any order of the boundaries, the same bits.
  add(AnalyticSlab{2.5, 3}, glass(0.3, 1.2));
  const Rgb forward = radiance({0.5, 0, 0.5}, {-1, 0, -1});
  reversed = true;
  EXPECT_EQ(radiance({0.5, 0, 0.5}, {-1, 0, -1}), forward);
}

TEST_F(Whitted, LightPassesAnyNumberOfBoundaries) {
  add(AnalyticSlab{-1, 0}, matt());
  double left = 1;
  for (int pane = 1; pane <= 12; ++pane) {
    scene.lights = {point_light({0, 0, 40})};
    add(AnalyticSlab{static_cast<double>(pane), pane + 0.5}, glass(0.9, 1.5));
    left *= 0.9 * 0.9;
    reversed = false;
    const Rgb forward = radiance({0.5, 0, 0.5}, {-1, 0, -1});
    EXPECT_NEAR(forward.r, left, tight) << pane;
    // The last panes are seen by any order of the boundaries: the same bits.
    reversed = true;
    EXPECT_EQ(radiance({0.5, 0, 0.5}, {-1, 0, -1}), forward) << pane;
    // What is opaque behind them leaves nothing.
    scene.lights = {point_light({0, 0, pane + 0.75}), point_light({0, 0, 41})};
    solids.push_back({AnalyticBall{{0, 0, 30}, 1}, MaterialId{0}, medium_opaque});
    EXPECT_EQ(radiance({0.5, 0, 0.5}, {-1, 0, -1}), forward) << pane;
    solids.pop_back();
  }
}

TEST_F(Whitted, LightIsTakenOffAlongItsWayThroughEachMedium) {
  add(AnalyticSlab{-1, 0}, matt());
  add(AnalyticSlab{1, 3}, glass(0.9, 1.5));
  add(AnalyticSlab{4, 9}, glass(0.8, 1.5));
  scene.media[scene.media.size() - 2].attenuation = {0.3, 0, 0.1};
  scene.media.back().attenuation = {0, 0.2, 0.5};
  // It stands within the second one.
  scene.lights = {point_light({0, 0, 6})};
  const double shares = 0.9 * 0.9 * 0.8;
  const Rgb lit = radiance({0.5, 0, 0.5}, {-1, 0, -1});
  EXPECT_NEAR(lit.r, shares * std::exp(-0.3 * 2), tight);
  EXPECT_NEAR(lit.g, shares * std::exp(-0.2 * 2), tight);
  EXPECT_NEAR(lit.b, shares * std::exp(-0.1 * 2 - 0.5 * 2), tight);
}

TEST_F(Whitted, PhongIsOpaqueAndMirrorsNothing) {
  Material m = glass(0.7, 1.5);
  m.model = MaterialModel::phong;
  m.ks = 0.3;
  add(AnalyticSlab{-1, 0}, m);
  scene.background = {1, 1, 1};
  EXPECT_EQ(radiance({0, 0, 5}, {0, 0, -1}), Rgb{});
  EXPECT_EQ(statistics.total().rays, 1U);
}

TEST_F(Whitted, MirrorShowsWhatStandsBeforeIt) {
  add(AnalyticSlab{-1, 0}, mirror(0.5));
  Material m = matt();
  m.color = Rgba{0, 1, 0, 1};
  add(AnalyticBall{{10, 0, 10}, 1}, m);
  scene.ambient = {0.8, 0.8, 0.8};
  scene.background = {0, 0, 1};
  EXPECT_EQ(radiance({-10, 0, 10}, {1, 0, -1}), (Rgb{0, 0.4, 0}));  // by way of the mirror, the ball
  EXPECT_EQ(radiance({-10, 0, 10}, {1, 1, -1}), (Rgb{0, 0, 0.5}));  // by way of the mirror, the sky
}

TEST_F(Whitted, RefractedRayFollowsSnell) {
  // A slab of glass over a wall lit by a spot of no width: where the ray comes out, the lateral shift of the plane
  // parallel plate is s = d tan(refracted).
  add(AnalyticSlab{0, 1}, glass(1, 1.5));
  Material wall = matt();
  add(AnalyticBall{{0, 0, -1000}, 999}, wall);
  scene.ambient = {1, 1, 1};
  const double in = 50 * std::numbers::pi / 180;
  const double refracted = std::asin(std::sin(in) / 1.5);

  AnalyticAccelerator accelerator(solids);
  const LitScene lit(scene);
  const Vec3 d{std::sin(in), 0, -std::cos(in)};
  RayQuery query;
  query.ray = {{0, 0, 1}, d};
  query.ray.origin = query.ray.at(-1);
  const auto context = accelerator.make_context();
  const Hit first = accelerator.first_hit(query, *context);
  EXPECT_NEAR(first.point.x, 0, tight);
  EXPECT_EQ(radiance(query.ray.origin, d), (Rgb{1, 1, 1}));
  EXPECT_EQ(statistics[RayKind::refracted].rays, 2U);

  // The wall is lit only in a narrow cone around the place where the ray must come out, seen from under the slab.
  const double shift = std::tan(refracted);
  const double reach = 1.0;  // below the slab to the ball's top, nearly a plane there
  const Vec3 expected{shift + reach * std::tan(in), 0, -1};
  Light spot;
  spot.kind = LightKind::spot;
  spot.position = expected + Vec3{0, 0, 0.5};
  spot.direction = {0, 0, -1};
  spot.angle = 2;
  spot.softness = 0;
  scene.lights = {spot};
  scene.ambient = {};
  EXPECT_GT(radiance(query.ray.origin, d).r, 0.99);
  scene.lights[0].position.x += 0.05;
  EXPECT_EQ(radiance(query.ray.origin, d).r, 0);
}

TEST_F(Whitted, LookingStraightThroughCostsKtTwice) {
  add(AnalyticBall{{0, 0, 0}, 1}, glass(0.9, 1.3));
  scene.background = {1, 0.5, 0.25};
  const Rgb light = radiance({0, 0, 5}, {0, 0, -1});
  EXPECT_NEAR(light.r, 0.81, tight);
  EXPECT_NEAR(light.b, 0.81 * 0.25, tight);
}

TEST_F(Whitted, TotalInternalReflectionTakesTheTransmittedShare) {
  add(AnalyticSlab{0, 1}, glass(0.8, 1.5));
  scene.background = {1, 1, 1};
  // Beyond the critical angle, asin(1/1.5) = 41.8 degrees, the ray stays inside until its depth ends it.
  const double a = 60 * std::numbers::pi / 180;
  EXPECT_EQ(radiance({0, 0, 0.5}, {std::sin(a), 0, std::cos(a)}, {10, 0}), Rgb{});
  EXPECT_EQ(statistics[RayKind::reflected].rays, 9U);
  EXPECT_EQ(statistics[RayKind::refracted].rays, 0U);
  // Below it, the ray leaves at once.
  const double b = 30 * std::numbers::pi / 180;
  EXPECT_NEAR(radiance({0, 0, 0.5}, {std::sin(b), 0, std::cos(b)}).r, 0.8, tight);
}

TEST_F(Whitted, IndexOneBendsNothing) {
  add(AnalyticBall{{0, 0, 0}, 1}, glass(1, 1));
  Material far = matt();
  far.color = Rgba{0, 0, 1, 1};
  add(AnalyticBall{{0.5, 0, -100}, 1e-6}, far);
  scene.ambient = {1, 1, 1};
  EXPECT_EQ(radiance({0.5, 0, 100}, {0, 0, -1}), (Rgb{0, 0, 1}));
}

// Trees of very different sizes grow together: in a mirror, in glass, on the floor, and nowhere.
TEST_F(Whitted, RaysOfACallDoNotKnowOfEachOther) {
  add(AnalyticSlab{-2, -1}, matt());
  add(AnalyticBall{{-1.2, 0, 0}, 1}, mirror(0.7));
  scene.background = {0.1, 0.3, 0.5};
  scene.ambient = {0.2, 0.1, 0.1};
  scene.lights = {point_light({2, -3, 5}), point_light({-4, 1, 6})};
  scene.lights[1].color = Rgba{1, 0.5, 0.25, 1};
  // Some that do not reach every surface, or stand in each other's way.
  scene.lights.push_back(point_light({0, -2, 5}));
  scene.lights[2].kind = LightKind::spot;
  scene.lights[2].angle = 15;
  scene.lights.push_back(point_light({1, -2.5, 4}));
  scene.lights[3].kind = LightKind::sphere;
  scene.lights[3].radius = 0.7;
  const std::uint64_t seed = 31;
  SCOPED_TRACE(seed);
  Random random(seed);
  for (const bool has_glass : {false, true}) {
    if (has_glass) {
      Material both = glass(0.7, 1.5);
      both.ks = 0.3;
      add(AnalyticBall{{1.2, 0, 0}, 1}, both);
    }
    std::vector<RayQuery> queries(150);
    for (RayQuery& query : queries)
      query.ray = {{0, -6, 1}, normalize({random.uniform(-3, 3), 6, random.uniform(-3, 1)})};
    EXPECT_EQ(radiance(queries, queries.size(), {7, 0}), radiance(queries, 1, {7, 0}));
  }
}

TEST_F(Whitted, DepthEndsTheTreeOfRays) {
  add(AnalyticSlab{-1, 0}, mirror(1));
  add(AnalyticSlab{1, 2}, mirror(1));
  for (int depth : {1, 2, 5, 1000}) {
    radiance({0, 0, 0.5}, {1, 0, 1}, {depth, 0});
    EXPECT_EQ(statistics[RayKind::reflected].rays, static_cast<std::uint64_t>(depth - 1));
  }
}

TEST_F(Whitted, CumulativeProductEndsTheTreeOfRays) {
  add(AnalyticSlab{-1, 0}, mirror(0.5));
  add(AnalyticSlab{1, 2}, mirror(0.5));
  radiance({0, 0, 0.5}, {1, 0, 1}, {1000, 0.01});
  EXPECT_EQ(statistics[RayKind::reflected].rays, 6U);  // 0.5^6 = 0.0156, 0.5^7 = 0.0078
}

TEST(InvisibleShare, IsHalfAStepNextToBlack) {
  for (int bits : {8, 16}) {
    const double steps = std::pow(2.0, bits) - 1;
    EXPECT_NEAR(srgb_from_linear(invisible_share(bits)) * steps, 0.5, 1e-12);
  }
}

}  // namespace
}  // namespace tenon
