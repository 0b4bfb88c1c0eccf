#include "accel/cells/crossing_group.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "accel/cells/cell_trace.h"

namespace tenon {
namespace {

using cells::Cell;
using cells::CrossingGroup;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A cell in which some leaves are crossed at 1, but for rounding, and the others far from there.
struct Scene {
  explicit Scene(std::mt19937_64& random) {
    cell.leaf_count = static_cast<std::uint8_t>(1 + random() % Cell::most_tabled);
    cell.table = random();
    for (std::uint32_t i = 0; i < cell.leaf_count; ++i) {
      const double here = 1 + static_cast<double>(static_cast<int>(random() % 5) - 2) * 0x1p-45;
      const std::uint64_t kind = random() % 5;
      enter[i] = kind == 0 ? infinity : kind == 1 ? -9 : kind <= 3 ? here : -8;
      leave[i] = kind == 0 ? infinity : kind <= 3 ? 9 + i : here;
      before |= static_cast<std::uint32_t>(enter[i] < 0) << i;
    }
  }

  /// What the classifier finds near 1.
  std::optional<Run> run() const {
    const cells::CellTree tree;
    cells::CellClassifier classifier({}, {}, Cell::most_tabled);
    constexpr double bound = 0x1p-40;
    for (std::uint32_t i = 0; i < cell.leaf_count; ++i) {
      Spans& spans = classifier.source().of_leaf.emplace_back();
      if (enter[i] == infinity) continue;
      spans.push_back({enter[i], bound, 2 * i + 1, true, false});
      spans.push_back({leave[i], bound, 2 * i, false, false});
    }
    classifier.state().enter(cell, tree);
    classifier.start();
    for (std::uint32_t i = 0; i < cell.leaf_count; ++i) classifier.reveal(LeafId{i});
    while (std::optional<Run> run = classifier.settle(infinity)) {
      if (run->t > 2) break;
      if (run->t > 0.5) return run;
    }
    return std::nullopt;
  }

  Cell cell;
  double enter[Cell::most_tabled] = {}, leave[Cell::most_tabled] = {};
  std::uint32_t before = 0;
};

TEST(CrossingGroup, SaysWhatTheClassifierSays) {
  constexpr unsigned seed = 41;
  std::mt19937_64 random(seed);
  std::size_t boundaries = 0, several = 0;
  for (int trial = 0; trial < 50000; ++trial) {
    const Scene scene(random);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", trial " << trial << ", table " << std::hex
                                    << scene.cell.table);
    CrossingGroup group;
    ASSERT_TRUE(group.collect(scene.cell.leaf_count, scene.enter, scene.leave, 1, 0x1p-20, 0x1p-30));
    const auto value_of = [&](std::uint32_t state) { return scene.cell.table >> state & 1; };
    const std::uint32_t after = group.after(scene.before);
    const bool changes = value_of(scene.before) != value_of(after);
    const std::optional<tenon::Run> run = scene.run();
    ASSERT_EQ(run.has_value(), changes);
    if (!run) continue;
    ++boundaries;
    const std::uint32_t faces = group.faces(value_of, after);
    const CrossingGroup::End& shown = group.shown(value_of, after, faces);
    EXPECT_EQ(run->t, group.first_change(value_of, after).t);
    EXPECT_EQ(run->surface, (LeafFace{LeafId{shown.place}, 2 * shown.place + (shown.entering ? 1U : 0U)}));
    EXPECT_EQ(run->leaf_entering, shown.entering);
    std::vector<LeafFace> expected;
    for (std::uint32_t place = 0; place < Cell::most_tabled; ++place) {
      if ((faces >> place & 1) != 0) expected.push_back({LeafId{place}, 2 * place + (group.enters(place) ? 1U : 0U)});
    }
    several += expected.size() > 1 ? 1 : 0;
    if (expected.empty()) expected.push_back(run->surface);
    ASSERT_EQ(run->faces.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(run->faces[i], expected[i]);
  }
  EXPECT_GT(boundaries, 10000U);
  EXPECT_GT(several, 5000U);
}

}  // namespace
}  // namespace tenon
