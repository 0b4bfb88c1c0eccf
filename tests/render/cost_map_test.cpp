#include "tenon/render/cost_map.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tenon/lang/load.h"

namespace tenon {
namespace {

Scene compiled(const std::string& text) {
  Diagnostics unheard;
  Result<Model> model = load_model_text(text, "test.scad", {}, unheard);
  EXPECT_TRUE(model.ok()) << format_error(model.error());
  Result<Scene> scene = compile_scene(std::move(*model), unheard);
  EXPECT_TRUE(scene.ok());
  return std::move(*scene);
}

// A mirror ball before a box with holes: shadow and reflected rays, and pixels that see nothing.
const char* const still = R"(
  difference() { cube(2, center = true); for (x = [-0.6, 0, 0.6]) translate([x, 0, 0]) cylinder(h = 3, r = 0.2, center = true); }
  material("mirror") translate([1.5, -1.5, 0]) sphere(0.6);
)";

RenderOptions small_options() {
  RenderOptions options;
  options.width = 37;
  options.height = 21;
  options.samples = 2;
  options.threads = 2;
  return options;
}

TEST(CostMap, AddsUpToWhatThePictureCosts) {
  const Scene scene = compiled(still);
  for (const char* spec : {"none", "nbvh", "okd", "grid", "bsp", "space-tracing", "median-bvh"}) {
    const auto accelerator = build_accelerator(spec, *scene.tree);
    ASSERT_TRUE(accelerator.ok());
    const Result<CostMap> map = measure_cost(scene, **accelerator, small_options());
    ASSERT_TRUE(map.ok());
    const Result<Rendering> picture = render(scene, **accelerator, small_options());
    ASSERT_TRUE(picture.ok());
    const TraversalCounters whole = picture->statistics.total(), mapped = map->statistics.total();
    EXPECT_EQ(mapped.rays, whole.rays) << spec;
    EXPECT_EQ(mapped.primitive_tests, whole.primitive_tests) << spec;
    EXPECT_EQ(mapped.cells_visited, whole.cells_visited) << spec;
    const auto sum = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
    EXPECT_EQ(sum(map->primitive_tests), static_cast<double>(whole.primitive_tests)) << spec;
    EXPECT_EQ(sum(map->cells_visited), static_cast<double>(whole.cells_visited)) << spec;
    EXPECT_GT(sum(map->seconds), 0) << spec;
  }
}

TEST(CostMap, KnowsWhereTheWorkIs) {
  const Scene scene = compiled("translate([-1, 0, 0]) cube(1); camera(from = [0, -6, 0], at = [0, 0, 0], fov = 50);");
  const auto accelerator = build_accelerator("nbvh", *scene.tree);
  RenderOptions options = small_options();
  options.samples = 1;
  const Result<CostMap> map = measure_cost(scene, **accelerator, options);
  ASSERT_TRUE(map.ok());
  double left = 0, right = 0;
  for (int y = 0; y < options.height; ++y) {
    for (int x = 0; x < options.width; ++x) {
      (2 * x < options.width ? left : right) += map->primitive_tests[map->window.index(x, y)];
    }
  }
  EXPECT_GT(left, 0);
  EXPECT_EQ(right, 0);
}

TEST(CostMap, TakingEachPixelAgainCountsOnce) {
  const Scene scene = compiled(still);
  const auto accelerator = build_accelerator("okd", *scene.tree);
  RenderOptions options = small_options();
  options.crop = PixelWindow{5, 4, 20, 20};
  const Result<CostMap> once = measure_cost(scene, **accelerator, options, 1);
  const Result<CostMap> thrice = measure_cost(scene, **accelerator, options, 3);
  ASSERT_TRUE(once.ok() && thrice.ok());
  EXPECT_EQ(once->window, *options.crop);
  EXPECT_EQ(once->primitive_tests, thrice->primitive_tests);
  EXPECT_EQ(once->statistics.total().rays, thrice->statistics.total().rays);
}

}  // namespace
}  // namespace tenon
