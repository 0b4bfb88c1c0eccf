#include "render/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "render/analytic_accelerator.h"
#include "render/whitted.h"

namespace tenon {
namespace {

Material matt(double kd) {
  Material m;
  m.kd = kd;
  m.ks = 0;
  m.color = Rgba{1, 1, 1, 1};
  return m;
}

// What n independent samples of a ray come to.
struct Estimate {
  double mean = 0, deviation = 0;  // of the mean
};

bool agree(const Estimate& a, const Estimate& b) {
  // 5.5 standard deviations are passed once in 2.6e7 pairs that agree; and rounding.
  const double deviation = std::sqrt(a.deviation * a.deviation + b.deviation * b.deviation);
  return std::fabs(a.mean - b.mean) <= 5.5 * deviation + 1e-12;
}

struct World {
  Scene scene;
  std::vector<AnalyticSolid> solids;

  void add(std::variant<AnalyticBall, AnalyticSlab> shape, const Material& material) {
    AnalyticSolid solid{shape, MaterialId{scene.materials.size()}, medium_opaque};
    scene.materials.push_back(material);
    if (material.is_transparent()) {
      solid.medium = static_cast<MediumId>(scene.media.size());
      scene.media.push_back({material.ior, {}});
    }
    solids.push_back(solid);
  }

  Estimate path(const RayQuery& query, int n, int depth, LightStrategy strategy = LightStrategy::both) const {
    const AnalyticAccelerator accelerator(solids);
    const auto context = accelerator.make_context();
    const LitScene lit(scene);
    PathIntegrator integrator(lit, accelerator, Sampler(9), depth, strategy);
    const auto count = static_cast<std::size_t>(n);
    const std::vector<RayQuery> queries(count, query);
    const std::vector<Hit> hits(count, accelerator.first_hit(query, *context));
    std::vector<SampleId> samples(count);
    for (int i = 0; i < n; ++i) samples[static_cast<std::size_t>(i)] = {i, static_cast<int>(strategy), 0};
    std::vector<Rgb> light(count);
    integrator.radiance(queries, hits, samples, light, *context);
    double sum = 0, squares = 0;
    for (const Rgb& l : light) sum += l.g, squares += l.g * l.g;
    return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)) / n)};
  }

  double whitted(const RayQuery& query, int depth) const {
    const AnalyticAccelerator accelerator(solids);
    const auto context = accelerator.make_context();
    const LitScene lit(scene);
    WhittedIntegrator integrator(lit, accelerator, {depth, 0});
    const Hit hit = accelerator.first_hit(query, *context);
    const SampleId sample{};
    Rgb light;
    integrator.radiance({&query, 1}, {&hit, 1}, {&sample, 1}, {&light, 1}, *context);
    return light.g;
  }
};

RayQuery ray(const Vec3& origin, const Vec3& direction) {
  RayQuery query;
  query.ray = {origin, normalize(direction)};
  return query;
}

Material material(MaterialModel model, double roughness = 0, double ior = 1) {
  Material m;
  m.model = model;
  m.roughness = roughness;
  m.ior = ior;
  m.color = Rgba{1, 1, 1, 1};
  return m;
}

Light uniform_world() {
  Light light;
  light.kind = LightKind::environment;
  return light;
}

TEST(PathTracing, BackgroundWhereNothingIsMet) {
  World world;
  world.scene.background = {0.25, 0.5, 0.75};
  EXPECT_EQ(world.path(ray({0, 0, 5}, {0, 0, 1}), 1, 9).mean, 0.5);
}

TEST(PathTracing, PointLightOverADiffuseSphereIsTheFormula) {
  World world;
  world.add(AnalyticBall{{0, 0, 0}, 1}, matt(0.6));
  Light light;
  light.position = {0, 3, 4};
  light.intensity = 2;
  world.scene.lights = {light};
  // At the pole the light stands 3 to the side and 3 above: kd I cos 45 degrees, and no rounding to speak of.
  EXPECT_NEAR(world.path(ray({0, 0, 5}, {0, 0, -1}), 1, 9).mean, 0.6 * 2 * std::sqrt(0.5), 1e-14);
  // With the square of the distance, 18, from where it has its intensity, 3.
  world.scene.lights[0].fade_distance = 3;
  EXPECT_NEAR(world.path(ray({0, 0, 5}, {0, 0, -1}), 1, 9).mean, 0.6 * 2 * std::sqrt(0.5) * 9 / 18, 1e-14);
}

// A ball of albedo 1 in light of radiance 1 from everywhere cannot be seen. What is smooth returns each path whole;
// where a path's weight varies its mean does, to four digits beside the error of so many samples.
TEST(PathTracing, WhiteFurnaceOfABall) {
  std::vector<Material> white{material(MaterialModel::lambert), material(MaterialModel::phong),
                              material(MaterialModel::whitted), material(MaterialModel::dielectric, 0, 1.5)};
  white[2].kd = 0.3, white[2].ks = 0.3, white[2].kt = 0.4, white[2].ior = 1.5;
  const std::size_t exact_from = 2;
  for (const double roughness : {0.0, 0.3, 0.7, 1.0}) {
    white.push_back(material(MaterialModel::conductor, roughness));
    white.push_back(material(MaterialModel::dielectric, roughness, 1.5));
    white.push_back(material(MaterialModel::principled, roughness, 1.5));
    Material layers = material(MaterialModel::principled, roughness, 1.5);
    layers.metallic = 0.3, layers.transmission = 0.5, layers.coat = 0.8, layers.coat_roughness = 0.4;
    white.push_back(layers);
  }
  for (std::size_t i = 0; i < white.size(); ++i) {
    World world;
    world.scene.lights = {uniform_world()};
    world.add(AnalyticBall{{0, 0, 0}, 1}, white[i]);
    for (const double off : {0.1, 0.8}) {
      const Estimate e = world.path(ray({off, 0, 5}, {0, 0, -1}), 1 << 13, 1000);
      EXPECT_NEAR(e.mean, 1, 5.5 * e.deviation + 1e-4) << "material " << i << ", " << off << " off the middle";
      EXPECT_LT(e.deviation, 0.02) << "material " << i;
      const bool is_smooth = i == 0 || i == exact_from || i == exact_from + 1;
      EXPECT_NEAR(e.mean, 1, is_smooth ? 1e-12 : 1) << "material " << i;
    }
  }
}

// Drawing lights, drawing directions, and both by the power heuristic, under lights of every extent.
TEST(PathTracing, StrategiesAgree) {
  Light rectangle, sphere, around;
  rectangle.kind = LightKind::rectangle;
  rectangle.position = {1, 0, 3};
  rectangle.edge_u = {2, 0, 0};
  rectangle.edge_v = {0, 2, 0};
  rectangle.intensity = 4;
  sphere.kind = LightKind::sphere;
  // Where the surfaces below see it: a light that no drawn direction meets would leave an estimate without deviation.
  sphere.position = {-2, -2, 2};
  sphere.radius = 0.6;
  sphere.intensity = 6;
  around.kind = LightKind::environment;
  auto map = std::make_shared<LightMap>(LightMap{16, 8, {}});
  for (int i = 0; i < 16 * 8 * 3; ++i) map->rgb.push_back(i / 3 == 37 ? 9.0F : 0.3F);
  around.map = map;
  const std::vector<std::vector<Light>> lightings{{rectangle}, {sphere}, {around}, {rectangle, sphere, around}};
  const Material surfaces[] = {material(MaterialModel::lambert), material(MaterialModel::conductor, 0.5),
                               material(MaterialModel::dielectric, 0.6, 1.5),
                               material(MaterialModel::principled, 0.4, 1.5)};
  for (std::size_t lighting = 0; lighting < lightings.size(); ++lighting) {
    for (const Material& surface : surfaces) {
      World world;
      world.scene.lights = lightings[lighting];
      world.add(AnalyticSlab{-1, 0}, matt(0.5));
      world.add(AnalyticBall{{0, 0, 0.7}, 0.6}, surface);
      for (const Vec3& to : {Vec3{0, -0.45, 1}, Vec3{0.9, -0.3, 0}}) {
        const RayQuery query = ray({0, -4, 3}, to - Vec3{0, -4, 3});
        const Estimate both = world.path(query, 1 << 12, 6);
        const Estimate lights = world.path(query, 1 << 12, 6, LightStrategy::lights);
        const Estimate bsdf = world.path(query, 1 << 12, 6, LightStrategy::bsdf);
        const std::string where = "lighting " + std::to_string(lighting) + ", model " +
                                  std::to_string(static_cast<int>(surface.model)) + ": " + std::to_string(both.mean) +
                                  ", " + std::to_string(lights.mean) + ", " + std::to_string(bsdf.mean);
        EXPECT_TRUE(agree(both, lights)) << where;
        EXPECT_TRUE(agree(both, bsdf)) << where;
        EXPECT_GT(both.mean, 1e-4) << where;
        EXPECT_GT(bsdf.mean, 0) << where;
      }
    }
  }
}

// Where nothing spreads light but the last surface, and lights have no extent, both integrators compute one thing.
TEST(PathTracing, AgreesWithWhittedWhereTheoryDoes) {
  World world;
  Light point, spot, sun;
  point.position = {3, -2, 6};
  point.intensity = 0.7;
  spot.kind = LightKind::spot;
  spot.position = {0, -1, 5};
  spot.angle = 40;
  spot.softness = 0.5;
  sun.kind = LightKind::directional;
  sun.direction = {1, 1, -3};
  sun.intensity = 0.4;
  world.scene.lights = {point, spot, sun};
  world.scene.ambient = {0.2, 0.2, 0.2};
  world.scene.background = {0.5, 0.6, 0.7};
  world.add(AnalyticBall{{0, 0, 0}, 1}, matt(0.8));
  Material mirror = material(MaterialModel::whitted), glass = mirror;
  mirror.kd = 0, mirror.ks = 0.9, mirror.shininess = 1e9;
  glass.kd = 0, glass.ks = 0.2, glass.kt = 0.8, glass.ior = 1.4, glass.shininess = 1e9;
  world.add(AnalyticBall{{3, 0, 0}, 1}, mirror);
  world.add(AnalyticBall{{-3, 0, 0}, 1}, glass);
  world.add(AnalyticBall{{0, 0, 3}, 0.7}, material(MaterialModel::dielectric, 0, 1.5));
  // A diffuse ball beside others is lit by them, which Whitted leaves out: it is seen alone, the others by the sky.
  World alone = world;
  alone.solids.resize(1);
  for (const double off : {0.0, 0.4, -0.7}) {
    const RayQuery query = ray({off, -5, 0.3}, {0, 1, 0});
    EXPECT_TRUE(agree(alone.path(query, 1 << 13, 9), {alone.whitted(query, 9), 0})) << off;
  }
  World sharp = world;
  sharp.solids.erase(sharp.solids.begin());
  for (const Vec3& to : {Vec3{3, 0, 0.2}, Vec3{-3, 0.2, 0}, Vec3{-3.4, 0, 0.3}, Vec3{0.1, 0, 3.2}, Vec3{0.4, 0, 2.9}}) {
    for (const int depth : {1, 3, 5}) {
      const RayQuery query = ray({0, -6, 0}, to - Vec3{0, -6, 0});
      // Within glass one path in 10^4 is left at the fifth level: it takes so many to see any.
      const int samples = depth < 5 ? 1 << 13 : 1 << 17;
      EXPECT_TRUE(agree(sharp.path(query, samples, depth), {sharp.whitted(query, depth), 0}))
          << to.x << ", depth " << depth;
    }
  }
}

TEST(PathTracing, BackdropIsSeenByTheCameraAlone) {
  World world;
  world.scene.lights = {uniform_world()};
  world.scene.background = {0.1, 0.2, 0.3};
  world.scene.shows_environment = false;
  world.add(AnalyticBall{{0, 0, 0}, 1}, material(MaterialModel::conductor));
  EXPECT_EQ(world.path(ray({0, 0, 5}, {0, 1, 0}), 1, 8).mean, 0.2);
  EXPECT_NEAR(world.path(ray({0, 0, 5}, {0, 0, -1}), 1, 8).mean, 1, 1e-12) << "a mirror shows the world around";
}

}  // namespace
}  // namespace tenon
