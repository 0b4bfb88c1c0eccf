#include "accel/bsp_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "accel/enclosed_boxes.h"

namespace tenon {
namespace {

using boxes::enclosed;

class BspTrees : public testing::TestWithParam<BspSplit> {
 protected:
  BspTree build(const std::vector<EnclosedLeaf>& leaves) const {
    return build_bsp_tree(leaves, hull_of(leaves, 0.01), {GetParam(), 4, 20});
  }
};

TEST_P(BspTrees, EachCellRefersToTheBoxesThatOverlapIt) {
  std::mt19937_64 rng(1);
  const auto leaves = enclosed(boxes::random_boxes(rng, 300));
  const BspTree tree = build(leaves);
  EXPECT_GT(tree.cells.size(), 50u);
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = boxes::random_point(rng, tree.box);
    std::uint32_t node = 0;
    while (!tree.nodes[node].is_leaf()) node = tree.nodes[node].first + side_of(tree.nodes[node], p, {1, 1, 1});
    const BspCell cell = tree.cells[tree.nodes[node].first];
    const auto first = tree.items.begin() + cell.first_item, last = first + cell.item_count;
    for (const EnclosedLeaf& l : leaves) {
      if (l.box.contains(p)) {
        EXPECT_NE(std::find(first, last, l.leaf), last);
      }
    }
  }
}

TEST_P(BspTrees, BoxesInOnePlaceMakeNeitherADeepNorALargeTree) {
  // All the same; and a heap that no plane through it thins out, with two boxes far away to draw planes to it.
  std::vector<Box3> same(10000, Box3{{0, 0, 0}, {1, 1, 1}});
  std::vector<Box3> heap(10000);
  for (std::size_t i = 0; i < heap.size(); ++i) {
    const double r = 1 + static_cast<double>(i) * 1e-5;
    heap[i] = {{-r, -r, -r}, {r, r, r}};
  }
  heap.push_back({{50, 50, 50}, {51, 51, 51}});
  heap.push_back({{-51, -51, -51}, {-50, -50, -50}});
  for (const auto& list : {same, heap}) {
    const BspTree tree = build(enclosed(list));
    EXPECT_LE(tree.items.size(), 16 * list.size() + 4096);
    EXPECT_LE(tree.depth, 20);
  }
}

TEST_P(BspTrees, FlatBoxesAreFound) {
  std::vector<Box3> flat;
  for (int i = 0; i < 100; ++i) flat.push_back({{0.0 + i, 0, 5}, {1.0 + i, 1, 5}});
  const BspTree tree = build(enclosed(flat));
  EXPECT_GE(tree.items.size(), flat.size());
  EXPECT_EQ(build({}).cells.size(), 1u);
  EXPECT_EQ(build(enclosed({{{1, 1, 1}, {1, 1, 1}}})).items.size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(, BspTrees, testing::Values(BspSplit::kaplan, BspSplit::macdonald_booth),
                         [](const auto& p) { return p.param == BspSplit::kaplan ? "kaplan" : "macdonald_booth"; });

}  // namespace
}  // namespace tenon
