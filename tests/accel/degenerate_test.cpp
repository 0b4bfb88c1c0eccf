#include "accel/battery.h"

// Trees and scenes that overflow, or split without end, where something is done by recursion or without a limit. Small
// bounds on the time are left to `tenon compare`; here they only have to end, and to be right.
namespace tenon {
namespace {

using fixtures::SceneBuilder;

constexpr int many = 100000;

// Quadratic by their nature, as `none` is for every ray; tried on fewer.
bool is_slow(const std::string& name) {
  return name == "goldsmith-bvh";
}

class Degenerate : public testing::TestWithParam<std::string> {
 protected:
  int count() const { return is_slow(GetParam()) ? many / 10 : many; }

  // The answers of `none` on a few rays.
  void check(const CsgTree& tree, const std::vector<Ray>& rays) {
    const auto none = build_accelerator("none", tree), judged = build_accelerator(GetParam(), tree);
    ASSERT_TRUE(judged.ok()) << judged.error().message;
    battery::RaySet set;
    for (const Ray& ray : rays) set.add(ray.origin, ray.direction);
    const battery::Verdict verdict = battery::judge(**none, **judged, set);
    EXPECT_EQ(verdict.mismatches, 0u) << verdict.first;
    EXPECT_EQ(verdict.seam_faults, 0u);
    EXPECT_GT(verdict.hits, 0u);
  }
};

// Each union holds the one before it and one sphere more: 10^5 levels.
TEST_P(Degenerate, LopsidedUnion) {
  SceneBuilder b;
  SceneNodeId node = b.sphere(0.3);
  for (int i = 1; i < count(); ++i) {
    node = b.unite({node, b.translate({1.0 * (i % 50), 1.0 * (i / 50 % 50), 1.0 * (i / 2500)}, b.sphere(0.3))});
  }
  check(b.tree(node), {{{-5, 0, 0}, {1, 0, 0}}, {{-5, -4, -3}, {1, 1.01, 0.98}}});
}

TEST_P(Degenerate, LopsidedDifference) {
  SceneBuilder b;
  SceneNodeId node = b.cube({100, 100, 100});
  for (int i = 1; i < count(); ++i) {
    node = b.subtract({node, b.translate({2.0 * (i % 50), 2.0 * (i / 50 % 50), 2.0 * (i / 2500)}, b.sphere(0.9))});
  }
  check(b.tree(node), {{{-5, 3.1, 2.2}, {1, 0, 0}}, {{-5, -4, -3}, {1, 1.01, 0.98}}});
}

TEST_P(Degenerate, AllInOnePoint) {
  SceneBuilder b;
  const SceneNodeId ball = b.sphere(1);
  check(b.tree(b.unite(std::vector<SceneNodeId>(static_cast<std::size_t>(count()), ball))),
        {{{-5, 0.1, 0.2}, {1, 0, 0}}});
}

TEST_P(Degenerate, AllFlat) {
  SceneBuilder b;
  std::vector<SceneNodeId> sheets;
  for (int i = 0; i < count(); ++i) {
    sheets.push_back(b.translate({0.01 * (i % 300), 0.01 * (i / 300), 1}, b.cube({0.009, 0.009, 1e-9})));
  }
  check(b.tree(b.unite(sheets)),
        {{{0.105, 0.105, 5}, {0, 0, -1}}, {{-1, -1, 3}, {1, 1, -1}}, {{-1, 0.005, 1}, {1, 0, 0}}});
}

INSTANTIATE_TEST_SUITE_P(Structures, Degenerate, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const std::string_view name : accelerator_names()) names.emplace_back(name);
                           return names;
                         }()),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace tenon
