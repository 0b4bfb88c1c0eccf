#include "render/path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/analytic_accelerator.h"

namespace tenon {
namespace {

Material matt(double kd) {
  Material m;
  m.kd = kd;
  m.ks = 0;
  m.color = Rgba{1, 1, 1, 1};
  return m;
}

class Path : public testing::Test {
 protected:
  void add(std::variant<AnalyticBall, AnalyticSlab> shape, const Material& material) {
    solids.push_back({shape, MaterialId{scene.materials.size()}, medium_opaque});
    scene.materials.push_back(material);
  }

  // The mean of n samples of a ray.
  Rgb radiance(const Vec3& origin, const Vec3& direction, std::uint32_t n, int depth = 1000) {
    const AnalyticAccelerator accelerator(solids);
    const auto context = accelerator.make_context();
    const LitScene lit(scene);
    PathIntegrator integrator(lit, accelerator, Sampler(1), depth);
    RayQuery query;
    query.ray = {origin, normalize(direction)};
    const std::vector<RayQuery> queries(n, query);
    const std::vector<Hit> hits(n, accelerator.first_hit(query, *context));
    std::vector<SampleId> samples(n);
    for (std::uint32_t i = 0; i < n; ++i) samples[i] = {0, 0, i};
    std::vector<Rgb> light(n);
    integrator.radiance(queries, hits, samples, light, *context);
    Rgb sum;
    for (const Rgb& l : light) sum += l;
    return sum * (1.0 / n);
  }

  Scene scene;
  std::vector<AnalyticSolid> solids;
};

TEST_F(Path, BackgroundWhereNothingIsMet) {
  scene.background = {0.25, 0.5, 0.75};
  EXPECT_EQ(radiance({0, 0, 5}, {0, 0, 1}, 1), scene.background);
}

TEST_F(Path, PointLightOverADiffuseSphereIsTheFormula) {
  add(AnalyticBall{{0, 0, 0}, 1}, matt(0.6));
  Light light;
  light.position = {0, 3, 4};
  light.intensity = 2;
  scene.lights = {light};
  // At the pole the light stands 3 to the side and 3 above: kd I cos 45 degrees, and no rounding to speak of.
  EXPECT_NEAR(radiance({0, 0, 5}, {0, 0, -1}, 1).g, 0.6 * 2 * std::sqrt(0.5), 1e-14);
}

// A convex solid reflects no light onto itself: what comes back is exactly its albedo.
TEST_F(Path, WhiteFurnaceOfADiffuseSphere) {
  add(AnalyticBall{{0, 0, 0}, 1}, matt(1));
  scene.ambient = {1, 1, 1};
  EXPECT_NEAR(radiance({0.6, 0, 5}, {0, 0, -1}, 64).r, 1, 1e-12);
}

}  // namespace
}  // namespace tenon
