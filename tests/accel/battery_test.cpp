#include "accel/battery.h"

#include "accel/structure.h"

namespace tenon {
namespace {

using battery::judge;
using battery::Verdict;

// Every accelerator, by its line in all.h, on every scene.
class Battery : public testing::TestWithParam<std::tuple<std::string, gallery::Scene>> {};

TEST_P(Battery, SaysWhatNoneSays) {
  const auto& [spec, scene] = GetParam();
  const CsgTree tree = scene.build();
  const auto none = build_accelerator("none", tree);
  const auto judged = build_accelerator(spec, tree);
  ASSERT_TRUE(judged.ok()) << judged.error().message;
  const int rounds = tree.leaves.size() > 100 ? 15 : 40;
  const Verdict verdict = judge(**none, **judged, battery::make_rays(tree, **none, rounds, 20));
  EXPECT_EQ(verdict.mismatches, 0u) << "of " << verdict.rays << " rays (" << verdict.hits << " hits); the first:\n"
                                    << verdict.first;
  EXPECT_EQ(verdict.seam_faults, 0u);
}

std::string test_name(const testing::TestParamInfo<Battery::ParamType>& info) {
  std::string name = std::get<0>(info.param) + "_on_" + std::get<1>(info.param).name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Structures, Battery,
                         testing::Combine(testing::ValuesIn(accelerator_specs()), testing::ValuesIn(gallery::scenes)),
                         test_name);

// That the battery can fail: structures that break their promise, each in one way.
struct FindsTooLittle {
  struct Scratch {};
  const CsgTree* tree;
  void traverse(Walk& walk, Scratch&) const {
    for (std::size_t i = 0; i < tree->leaves.size(); ++i) {
      if (i % 5 != 0) walk.reveal(LeafId{i});
    }
  }
  std::size_t memory_bytes() const { return 0; }
  std::size_t boxes() const { return 0; }
  int depth() const { return 0; }
};

struct SettlesTooEarly : FindsTooLittle {
  void traverse(Walk& walk, Scratch&) const {
    for (std::size_t i = 0; i < tree->leaves.size(); ++i) {
      if (walk.settle(0.5 * static_cast<double>(i))) return;
      walk.reveal(LeafId{i});
    }
  }
};

template <class Broken>
Verdict judge_broken(const CsgTree& tree) {
  const auto none = build_accelerator("none", tree);
  Broken broken;
  broken.tree = &tree;
  const StructureAccelerator<Broken> accelerator(tree, broken);
  return judge(**none, accelerator, battery::make_rays(tree, **none, 20, 21));
}

TEST(BatteryControl, AMissingLeafIsSeen) {
  EXPECT_GT(judge_broken<FindsTooLittle>(gallery::swarm_scene()).mismatches, 0u);
}

TEST(BatteryControl, ALateLeafIsSeen) {
  const Verdict verdict = judge_broken<SettlesTooEarly>(gallery::random_scene(3, 60, 3));
  EXPECT_GT(verdict.mismatches, 0u);
  EXPECT_GT(verdict.seam_faults, 0u);
}

TEST(BatteryControl, TheRaysOfEverySceneMeetSomething) {
  for (const gallery::Scene& scene : gallery::scenes) {
    if (scene.name == std::string_view("none") || scene.name == std::string_view("cancelled")) continue;
    const CsgTree tree = scene.build();
    const auto none = build_accelerator("none", tree);
    const Verdict verdict = judge(**none, **none, battery::make_rays(tree, **none, 4, 22));
    EXPECT_GT(verdict.hits, verdict.rays / 10) << scene.name;
  }
}

}  // namespace
}  // namespace tenon
