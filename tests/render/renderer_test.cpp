#include "tenon/render/renderer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "render/analytic_accelerator.h"
#include "render/noise.h"
#include "render/tile_cut.h"
#include "render/tiles.h"
#include "support/random.h"

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
    scene.media = {{}, {}, {1.5, {}}};
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

bool same_planes(const Film& a, const Film& b) {
  bool same = a.window() == b.window() && a.layers() == b.layers();
  const auto compare = [&](std::string_view, auto plane_of) {
    same = same && plane_of(a.planes()) == plane_of(b.planes());
  };
  for_each_sum(compare);
  for_each_first(compare);
  return same;
}

class SameBytes : public testing::TestWithParam<IntegratorKind> {
 protected:
  RenderOptions options() const {
    RenderOptions options = small();
    options.integrator = GetParam();
    options.samples = 5;
    options.layers = Layers{Layer::variance};
    return options;
  }
  const Still still;
};

TEST_P(SameBytes, ForAnyThreads) {
  const Rendering reference = still.render(options());
  for (int threads : {2, 7}) {
    RenderOptions other_options = options();
    other_options.threads = threads;
    const Rendering other = still.render(other_options);
    EXPECT_TRUE(same_planes(reference.film, other.film)) << threads << " threads";
    EXPECT_EQ(reference.statistics.total().rays, other.statistics.total().rays);
  }
}

TEST_P(SameBytes, FromAnyCropsAndSlices) {
  const std::uint64_t seed = 4;
  SCOPED_TRACE(seed);
  Random random(seed);
  const RenderOptions whole = options();
  const Rendering reference = still.render(whole);
  for (int round = 0; round < 4; ++round) {
    const int x = 1 + random.below(whole.width - 1), y = 1 + random.below(whole.height - 1);
    const std::uint32_t slice = 1 + static_cast<std::uint32_t>(random.below(4));
    Film sum(whole.width, whole.height, {0, 0, whole.width, whole.height}, film_layers(whole));
    for (const PixelWindow& crop : {PixelWindow{x, 0, whole.width, y}, PixelWindow{0, 0, x, whole.height},
                                    PixelWindow{x, y, whole.width, whole.height}}) {
      for (const bool late : {true, false}) {
        RenderOptions part = whole;
        part.crop = crop;
        (late ? part.first_sample : part.end_sample.emplace()) = slice;
        sum.add(still.render(part).film);
      }
    }
    EXPECT_TRUE(same_planes(reference.film, sum)) << x << ' ' << y << ' ' << slice;
  }
}

// Breaks the work off again and again, and takes it up from what a checkpoint has.
TEST_P(SameBytes, WithBreaks) {
  for (const double noise : {0.0, 0.05}) {
    RenderOptions broken = options();
    broken.samples = 40;
    broken.width = broken.height = 40;
    broken.noise = noise;
    const Rendering reference = still.render(broken);
    std::optional<Film> kept;
    RenderEnd end = RenderEnd::interrupted;
    int breaks = 0;
    for (; end == RenderEnd::interrupted; ++breaks) {
      int tiles = 0;
      RenderControl control;
      control.interrupted = [&] { return ++tiles > 8; };
      control.resumed = kept ? &*kept : nullptr;
      auto part = render(still.scene, still.accelerator, broken, control);
      ASSERT_TRUE(part.ok());
      end = part->end;
      kept = std::move(part->film);
    }
    EXPECT_GT(breaks, 5);
    EXPECT_TRUE(same_planes(reference.film, *kept)) << "noise " << noise;
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
  ASSERT_TRUE(render(still.scene, still.accelerator, small(), {.progress = &progress}).ok());
  EXPECT_EQ(progress.total, 75U * 50U * 3U);
  EXPECT_EQ(progress.done, progress.total);
}

TEST(Renderer, NoiseTargetIsMetWithFewerSamples) {
  const Still still;
  RenderOptions options = small();
  options.integrator = IntegratorKind::path;
  options.samples = 512;
  options.noise = 0.02;
  const Rendering rendering = still.render(options);
  ASSERT_EQ(rendering.end, RenderEnd::finished);
  const TileGrid tiles(rendering.film.window());
  std::set<std::uint32_t> counts;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const std::uint32_t taken = rendering.film.samples(tiles[i].x0, tiles[i].y0);
    counts.insert(taken);
    EXPECT_GE(taken, least_samples_for_noise);
    if (taken == options.samples) continue;
    EXPECT_LE(noise(rendering.film, tiles[i]), options.noise) << i;
  }
  EXPECT_GT(counts.size(), 2U);
  EXPECT_LT(*counts.begin(), 100U);
  // A settled tile needs nothing more: the work is done.
  ASSERT_EQ(rendering.done.size(), 1U);
  EXPECT_EQ(rendering.done[0], (SampleBox{{0, 0, options.width, options.height}, 0, options.samples}));
}

// Of most_samples a pixel, a share that nobody would wait for.
TEST(Renderer, ProgressForesaysWhenNoiseWillBeGone) {
  const Still still;
  RenderOptions options = small();
  options.integrator = IntegratorKind::path;
  options.samples = most_samples;
  options.noise = 0.02;
  ProgressCounters progress;
  std::vector<std::pair<double, double>> shown;
  RenderControl control;
  control.progress = &progress;
  control.interrupted = [&] {
    shown.emplace_back(static_cast<double>(progress.done), static_cast<double>(progress.total));
    return false;
  };
  ASSERT_TRUE(render(still.scene, still.accelerator, options, control).ok());
  EXPECT_EQ(progress.done, progress.total);
  const auto in_the_end = static_cast<double>(progress.total);
  for (const auto& [done, total] : shown) {
    if (done < 0.5 * in_the_end) continue;
    EXPECT_GT(total, 0.8 * in_the_end);
    EXPECT_LT(total, 1.25 * in_the_end);
  }
}

TEST(Renderer, NoiseTargetDecidesAlikeInACrop) {
  const Still still;
  RenderOptions options = small();
  options.integrator = IntegratorKind::path;
  options.samples = 128;
  options.noise = 0.1;
  const Rendering whole = still.render(options);
  options.crop = PixelWindow{21, 19, 40, 23};
  EXPECT_TRUE(same_planes(whole.film.cropped(*options.crop), still.render(options).film.cropped(*options.crop)));
}

TEST(Renderer, EndsWhenTimeIsOverButNotBeforeEachPixelHasASample) {
  const Still still;
  RenderOptions options = small();
  options.samples = most_samples;
  options.seconds = 1e-9;
  const Rendering rendering = still.render(options);
  EXPECT_EQ(rendering.end, RenderEnd::out_of_time);
  for (const std::uint32_t samples : rendering.film.planes().samples) EXPECT_EQ(samples, 1U);
  EXPECT_EQ(rendering.done, (std::vector<SampleBox>{{{0, 0, options.width, options.height}, 0, 1}}));
}

TEST(Renderer, CheckpointsHoldWhatTheySay) {
  const Still still;
  RenderControl control;
  control.checkpoint_seconds = 0;
  std::uint64_t before = 0;
  int checkpoints = 0;
  control.checkpoint = [&](const Film& film, const std::vector<SampleBox>& done) {
    std::uint64_t said = 0, there = 0;
    for (const SampleBox& box : done) said += box.samples();
    for (const std::uint32_t samples : film.planes().samples) there += samples;
    EXPECT_EQ(said, there);
    EXPECT_GE(there, before);
    before = there;
    ++checkpoints;
    control.checkpoint_seconds = checkpoints < 5 ? 0 : 1e9;
  };
  ASSERT_TRUE(render(still.scene, still.accelerator, small(), control).ok());
  EXPECT_EQ(checkpoints, 5);
}

// Between two floors without end no path finds a way out: each surface keeps half of the light, and adds as much again.
struct TwoFloors : Still {
  explicit TwoFloors(double emission) {
    Material matt;
    matt.kd = 0.5, matt.ks = 0, matt.emission = emission;
    matt.color = Rgba{1, 1, 1, 1};
    scene.materials = {matt};
    scene.lights.clear();
    scene.ambient = {};
    scene.camera.from = {0, 0, 0};
    scene.camera.at = {1, 0, 0};
    accelerator = AnalyticAccelerator(
        {{AnalyticSlab{-2, -1}, MaterialId{0}, medium_opaque}, {AnalyticSlab{1, 2}, MaterialId{0}, medium_opaque}});
  }
};

TEST(Renderer, DepthCutsWhatLightWouldStillBring) {
  const TwoFloors lit(1), dark(0);
  RenderOptions options = small();
  options.integrator = IntegratorKind::path;
  options.depth = 4;
  // Up to the fourth surface nothing is left to chance; light is 1 + 1/2 + 1/4 + ...
  const DepthCut cut = lit.render(options).cut;
  EXPECT_EQ(cut.paths, 75U * 50U * 3U);
  EXPECT_NEAR(cut.share, std::pow(0.5, 4), 1e-12);
  EXPECT_GT(cut.largest_share, 0.5 * cut.share);
  EXPECT_LT(cut.largest_share, cut.share);
  EXPECT_TRUE(cut.may_be_seen());
  // Later surfaces are reached by chance.
  options.depth = 8;
  options.samples = 64;
  EXPECT_NEAR(lit.render(options).cut.share, std::pow(0.5, 8), 0.001);
  EXPECT_FALSE(lit.render(options).cut.may_be_seen());
  // Paths that never meet light are no loss, however long they are.
  const DepthCut nothing = dark.render(options).cut;
  EXPECT_GT(nothing.paths, 0U);
  EXPECT_EQ(nothing.share, 0);
}

// A pixel counts as one, however many samples it needs: one tile has the light of paths that are cut, and 64 times the
// samples of the other.
TEST(DepthCut, IsAShareOfThePictureNotOfTheSamples) {
  const TileCut cut{{0, 0, 16, 16}, 16384, {5000, 4000, 16384, 2000, 1000}};
  const TileCut whole{{16, 0, 32, 16}, 256, {0, 0, 256, 0, 0}};
  const DepthCut both = depth_cut(std::array{cut, whole});
  // The next quarters bring 500, 250, ... of light.
  EXPECT_NEAR(both.share, 1000.0 / 16384 / (2 + 1000.0 / 16384), 1e-12);
  EXPECT_EQ(both.tile, cut.tile);
  EXPECT_EQ(both.paths, 5000U);
}

TEST(Renderer, TransparentBackgroundIsNotThere) {
  Still still;
  still.scene.camera.at = {0, 0, 4};
  RenderOptions options = small();
  const Rendering opaque = still.render(options);
  options.transparent = true;
  const Rendering transparent = still.render(options);
  EXPECT_EQ(opaque.film.alpha(0, 0), 1);
  EXPECT_EQ(transparent.film.alpha(0, 0), 0);
  EXPECT_EQ(transparent.film.light(0, 0), Rgb{});
  EXPECT_EQ(transparent.film.alpha(37, 49), 1);
  EXPECT_EQ(transparent.film.light(37, 49), opaque.film.light(37, 49));
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
  // Each of 64 by 64 cells holds a point. The rim passes fewer than 256 of them, and in each of those the share that is
  // covered is missed by up to half a cell: by sqrt(256) / 2 / 4096 = 0.002 in all if that were by chance; three times.
  EXPECT_NEAR(rendering->film.light(0, 0).r, 0.78539816339, 0.006);
}

TEST(Renderer, CameraThatSeesNothingIsAnError) {
  Still still;
  still.scene.camera.at = still.scene.camera.from;
  const auto result = render(still.scene, still.accelerator, small());
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::input);
}

TEST(TileGrid, CoversEveryPixelOnce) {
  for (const PixelWindow& window :
       {PixelWindow{0, 0, 37, 21}, PixelWindow{5, 16, 17, 33}, PixelWindow{31, 31, 32, 32}}) {
    const TileGrid tiles(window);
    std::vector<int> covered(40 * 40);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const PixelWindow tile = tiles[i];
      EXPECT_EQ(tile.x0 / TileGrid::side, (tile.x1 - 1) / TileGrid::side);
      EXPECT_EQ(tile.y0 / TileGrid::side, (tile.y1 - 1) / TileGrid::side);
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) ++covered[static_cast<std::size_t>(y * 40 + x)];
      }
    }
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 40; ++x) {
        EXPECT_EQ(covered[static_cast<std::size_t>(y * 40 + x)], window.contains(x, y) ? 1 : 0);
      }
    }
  }
}

}  // namespace
}  // namespace tenon
