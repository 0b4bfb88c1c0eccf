#include "tenon/render/renderer.h"

#include <gtest/gtest.h>

#include <cstring>

#include "render/analytic_accelerator.h"
#include "render/tiles.h"

namespace tenon {
namespace {

// Two balls of glass and mirror over a floor, seen from above.
struct Still {
  Scene scene;
  AnalyticAccelerator accelerator{{}};

  Still() {
    Material floor, glass, mirror;
    floor.color = glass.color = mirror.color = Rgba{0.9, 0.8, 0.7, 1};
    glass.model = mirror.model = MaterialModel::whitted;
    glass.kd = 0.1, glass.ks = 0.1, glass.kt = 0.8, glass.ior = 1.5;
    mirror.kd = 0.2, mirror.ks = 0.8;
    scene.materials = {floor, glass, mirror};
    scene.medium_ior = {1, 1, 1.5};
    scene.background = {0.2, 0.3, 0.4};
    scene.ambient = {0.3, 0.3, 0.3};
    Light light;
    light.position = {3, -5, 9};
    scene.lights = {light};
    scene.camera.from = {0, -6, 4};
    accelerator = AnalyticAccelerator({{AnalyticSlab{-2, -1}, MaterialId{0}, medium_opaque},
                                       {AnalyticBall{{-1.1, 0, 0}, 1}, MaterialId{1}, 2},
                                       {AnalyticBall{{1.1, 0, 0}, 1}, MaterialId{2}, medium_opaque}});
  }

  Rendering render(RenderOptions options) const {
    auto result = tenon::render(scene, accelerator, options);
    EXPECT_TRUE(result.ok());
    return std::move(*result);
  }
};

RenderOptions small() {
  RenderOptions options;
  options.width = 75;
  options.height = 50;
  options.samples = 3;
  options.threads = 1;
  return options;
}

bool same_bytes(const Film& a, const Film& b) {
  return a.rgb().size() == b.rgb().size() && std::memcmp(a.rgb().data(), b.rgb().data(), a.rgb().size_bytes()) == 0;
}

class SameBytes : public testing::TestWithParam<IntegratorKind> {};

TEST_P(SameBytes, ForAnyThreadsAndTiles) {
  const Still still;
  RenderOptions options = small();
  options.integrator = GetParam();
  const Rendering reference = still.render(options);
  for (int threads : {1, 2, 7}) {
    for (int tile_size : {1, 16, 33, 1000}) {
      options.threads = threads;
      options.tile_size = tile_size;
      const Rendering other = still.render(options);
      EXPECT_TRUE(same_bytes(reference.film, other.film)) << threads << " threads, tiles of " << tile_size;
      EXPECT_EQ(reference.statistics.total().rays, other.statistics.total().rays);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Renderer, SameBytes, testing::Values(IntegratorKind::whitted, IntegratorKind::path),
                         [](const auto& test) { return test.param == IntegratorKind::path ? "path" : "whitted"; });

TEST(Renderer, CountsItsRays) {
  const Still still;
  const Rendering rendering = still.render(small());
  EXPECT_EQ(rendering.statistics[RayKind::primary].rays, 75U * 50U * 3U);
  EXPECT_GT(rendering.statistics[RayKind::shadow].rays, 0U);
  EXPECT_GT(rendering.statistics[RayKind::reflected].rays, 0U);
  EXPECT_GT(rendering.statistics[RayKind::refracted].rays, 0U);
}

TEST(Renderer, ProgressEndsAtItsTotal) {
  const Still still;
  ProgressCounters progress;
  ASSERT_TRUE(render(still.scene, still.accelerator, small(), &progress).ok());
  EXPECT_EQ(progress.total, 75U * 50U * 3U);
  EXPECT_EQ(progress.done, progress.total);
}

TEST(Renderer, MeanOfItsSamples) {
  // A ball covers pi/4 of the square pixel it is inscribed in.
  Scene scene;
  Material white;
  white.kd = 1, white.ks = 0, white.color = Rgba{1, 1, 1, 1};
  scene.materials = {white};
  scene.ambient = {1, 1, 1};
  scene.camera.projection = Projection::orthographic;
  scene.camera.from = {0, -10, 0};
  scene.camera.width = 2;
  const AnalyticAccelerator accelerator({{AnalyticBall{{0, 0, 0}, 1}, MaterialId{0}, medium_opaque}});
  RenderOptions options;
  options.width = options.height = 1;
  options.samples = 4096;
  const auto rendering = render(scene, accelerator, options);
  ASSERT_TRUE(rendering.ok());
  // Points of low discrepancy miss the area of a smooth convex set by about n^(-2/3).
  EXPECT_NEAR(rendering->film.at(0, 0).r, 0.78539816339, 0.004);
}

TEST(Renderer, CameraThatSeesNothingIsAnError) {
  Still still;
  still.scene.camera.at = still.scene.camera.from;
  const auto result = render(still.scene, still.accelerator, small());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::input);
}

TEST(TileGrid, CoversEveryPixelOnce) {
  for (int size : {1, 3, 16, 100}) {
    const TileGrid tiles(37, 21, size);
    std::vector<int> covered(37 * 21);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const Tile tile = tiles[i];
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) ++covered[static_cast<std::size_t>(y * 37 + x)];
      }
    }
    for (int c : covered) EXPECT_EQ(c, 1);
  }
}

}  // namespace
}  // namespace tenon
