#include "kdtree/kd_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kdtree/kd_events.h"
#include "support/random_boxes.h"

namespace tenon {
namespace {

TEST(KdNode, KeepsEverythingInEightBytes) {
  const KdNode inner = KdNode::inner(2, -1.5f, KdNode::index_limit - 1);
  EXPECT_FALSE(inner.is_leaf());
  EXPECT_EQ(inner.axis(), 2);
  EXPECT_EQ(inner.plane(), -1.5);
  EXPECT_EQ(inner.index(), KdNode::index_limit - 1);
  const KdNode leaf = KdNode::leaf(123456, 0xffffffff);
  EXPECT_TRUE(leaf.is_leaf());
  EXPECT_EQ(leaf.index(), 123456u);
  EXPECT_EQ(leaf.item_count(), 0xffffffffu);
  EXPECT_TRUE(KdNode().is_leaf());
}

// Every bound of every item is tried, and each time all items are counted: eq. 1.2 and 2.1 as they stand.
double least_cost_by_definition(const std::vector<KdFloatItem>& items, const Box3& cell, KdSplit split, double ct) {
  const double area = cell.surface_area();
  double best = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    for (const KdFloatItem& candidate : items) {
      for (const float plane : {candidate.lower[a], candidate.upper[a]}) {
        if (!(cell.lower[axis] < plane && plane < cell.upper[axis])) continue;
        Box3 cell_below = cell, cell_above = cell, cut = cell;
        cell_below.upper[axis] = cell_above.lower[axis] = cut.lower[axis] = cut.upper[axis] = plane;
        double below = 0, above = 0, both = 0, flat = 0;
        for (const KdFloatItem& i : items) {
          if (i.lower[a] == plane && i.upper[a] == plane) flat += i.cost;
          if (i.lower[a] < plane) below += i.cost;
          if (i.upper[a] > plane) above += i.cost;
          if (i.lower[a] < plane && i.upper[a] > plane) both += i.cost;
        }
        for (const double flat_below : {flat, 0.0}) {
          double cost = ct + cell_below.surface_area() / area * (below + flat_below) +
                        cell_above.surface_area() / area * (above + flat - flat_below);
          if (split == KdSplit::msah) cost -= cut.surface_area() / 2 / area * both;
          best = std::min(best, cost);
        }
      }
    }
  }
  return best;
}

TEST(KdTree, OnePassOverEventsFindsWhatTryingEverythingFinds) {
  std::mt19937_64 rng(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<KdFloatItem> items;
    double total = 0;
    Box3 cell;
    for (const Box3& b : boxes::random_boxes(rng, 1 + rng() % 25)) {
      KdFloatItem item{{}, {}, 0.5 * static_cast<double>(1 + rng() % 20)};
      for (int axis = 0; axis < 3; ++axis) {
        item.lower[static_cast<std::size_t>(axis)] = static_cast<float>(b.lower[axis]);
        item.upper[static_cast<std::size_t>(axis)] = static_cast<float>(b.upper[axis]);
      }
      items.push_back(item);
      total += item.cost;
      cell = hull(cell, b);
    }
    // Sometimes a cell that cuts through the items.
    if (round % 2 == 0) cell = grown(cell, -1.5);
    if (cell.is_empty()) continue;
    if (round % 2 == 0) {
      std::erase_if(items, [&](const KdFloatItem& i) {
        const Box3 b{{i.lower[0], i.lower[1], i.lower[2]}, {i.upper[0], i.upper[1], i.upper[2]}};
        if (!b.overlaps(cell)) total -= i.cost;
        return !b.overlaps(cell);
      });
    }
    for (const KdSplit split : {KdSplit::sah, KdSplit::msah}) {
      const auto plane =
          find_cheapest_plane(sorted_events(items), items, total, cell, SurfaceAreaHeuristic(split, 0.5, cell));
      const double expected = least_cost_by_definition(items, cell, split, 0.5);
      ASSERT_EQ(plane.has_value(), expected < std::numeric_limits<double>::infinity());
      if (plane) {
        EXPECT_NEAR(plane->cost, expected, 1e-12 * expected);
      }
    }
  }
}

std::vector<KdItem> items_of(const std::vector<Box3>& list) {
  std::vector<KdItem> items;
  for (std::uint32_t i = 0; i < list.size(); ++i) items.push_back({i, list[i], 1});
  return items;
}

TEST(KdTree, EachLeafRefersToTheBoxesThatHoldItsPoints) {
  std::mt19937_64 rng(2);
  const auto list = boxes::random_boxes(rng, 400);
  for (const KdSplit split : {KdSplit::sah, KdSplit::msah}) {
    const KdTree tree = build_kd_tree(items_of(list), {split, 0.1, -1});
    EXPECT_GT(tree.nodes.size(), 100u);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = boxes::random_point(rng, tree.box);
      KdNode node = tree.nodes[0];
      while (!node.is_leaf()) node = tree.nodes[node.index() + (p[node.axis()] > node.plane() ? 1 : 0)];
      const auto here = tree.items_of(node);
      for (std::uint32_t k = 0; k < list.size(); ++k) {
        if (list[k].contains(p)) {
          EXPECT_NE(std::find(here.begin(), here.end(), k), here.end());
        }
      }
    }
  }
}

// §4.3 of the thesis: a sphere and six tori concentric with it, whose boxes all overlap. A torus costs nine spheres.
TEST(KdTree, TheGroovedSphereIsOneLeaf) {
  std::vector<KdItem> items{{0, {{-1, -1, -1}, {1, 1, 1}}, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Box3 torus{{-0.99, -0.99, -0.99}, {0.99, 0.99, 0.99}};
      torus.lower[axis] = side * 0.374 - 0.09;
      torus.upper[axis] = side * 0.374 + 0.09;
      items.push_back({static_cast<std::uint32_t>(items.size()), torus, 9});
    }
  }
  for (const KdSplit split : {KdSplit::sah, KdSplit::msah}) {
    for (const bool equal_costs : {false, true}) {
      auto priced = items;
      for (KdItem& item : priced) {
        if (equal_costs) item.cost = 1;
      }
      const KdTree tree = build_kd_tree(priced, {split, KdOptions{}.traversal_cost, -1});
      ASSERT_EQ(tree.nodes.size(), 1u);
      EXPECT_EQ(tree.nodes[0].item_count(), 7u);
    }
  }
}

TEST(KdTree, BoxesInOnePlaceMakeNeitherADeepNorALargeTree) {
  std::vector<Box3> heap(20000), flat(20000);
  for (std::size_t i = 0; i < heap.size(); ++i) {
    const double r = 1 + static_cast<double>(i) * 1e-5, x = static_cast<double>(i);
    heap[i] = {{-r, -r, -r}, {r, r, r}};
    flat[i] = {{x, 0, 3}, {x + 2, 1, 3}};
  }
  for (const auto& list : {std::vector<Box3>(20000, heap[0]), heap, flat}) {
    const KdTree tree = build_kd_tree(items_of(list), {KdSplit::msah, 0, -1});
    EXPECT_GE(tree.items.size(), list.size());
    EXPECT_LE(tree.items.size(), 16 * list.size() + 4096);
    EXPECT_LE(tree.depth, KdTree::deepest);
  }
  EXPECT_EQ(build_kd_tree({}, {}).nodes.size(), 1u);
}

}  // namespace
}  // namespace tenon
