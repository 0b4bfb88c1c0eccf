#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "rays/chord_error.h"
#include "rays/ray_sets.h"

// The bench's own logic; nothing here is timed.
namespace tenon::bench {
namespace {

BenchScene read(const std::string& name) {
  Result<BenchScene> scene = read_scene(std::string(TENON_ROOT) + "/" + scene_path(name));
  EXPECT_TRUE(scene.ok()) << (scene ? "" : format_error(scene.error()));
  return std::move(*scene);
}

TEST(ChordError, IsAQuarterOfAPixelOnTheScreen) {
  const double half_width = std::tan(20 * std::numbers::pi / 180), depth = 7;
  const double error = chord_error(half_width, 640, depth);
  EXPECT_NEAR(error / depth / (2 * half_width) * 640, 0.25, 1e-12);
  EXPECT_NEAR(chord_error(half_width, 1920, depth), error / 3, 1e-15);
}

TEST(PixelPlace, VisitsEveryPixelOnceAndBlocksOfSixteenTogether) {
  std::set<std::pair<int, int>> seen;
  constexpr std::size_t pixels = std::size_t{picture_width} * picture_height;
  for (std::size_t i = 0; i < pixels; ++i) {
    const PixelPlace p = pixel_place(i), first = pixel_place(i - i % 16);
    EXPECT_TRUE(p.x - first.x < 4 && p.x >= first.x && p.y - first.y < 4 && p.y >= first.y);
    seen.insert({p.x, p.y});
  }
  EXPECT_EQ(seen.size(), pixels);
  EXPECT_EQ(*seen.rbegin(), std::make_pair(picture_width - 1, picture_height - 1));
}

TEST(RaySets, DoNotDependOnTheStructureAndLeaveTheSurface) {
  const BenchScene scene = read("grooved_sphere");
  const auto a = build_accelerator("goldsmith-bvh", *scene.scene.tree),
             b = build_accelerator("grid", *scene.scene.tree);
  const std::vector<RaySet> first = make_ray_sets(scene, **a, 1e-3), second = make_ray_sets(scene, **b, 1e-3);
  ASSERT_EQ(first.size(), 3U);
  for (std::size_t s = 0; s < first.size(); ++s) {
    ASSERT_EQ(first[s].rays.size(), second[s].rays.size());
    ASSERT_GT(first[s].rays.size(), 100000U);
    for (std::size_t i = 0; i < first[s].rays.size(); ++i) {
      ASSERT_EQ(first[s].rays[i].ray.origin, second[s].rays[i].ray.origin);
      ASSERT_EQ(first[s].rays[i].ray.direction, second[s].rays[i].ray.direction);
    }
  }
}

TEST(BenchScenes, AllAreThere) {
  for (const std::string& name : scene_names()) EXPECT_GT(scene_figures(read(name).scene).primitives, 6U) << name;
}

}  // namespace
}  // namespace tenon::bench
