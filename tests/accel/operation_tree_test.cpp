#include "accel/operation_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "accel/operation_marks.h"
#include "csg/made_up.h"

namespace tenon {
namespace {

using made_up::TreeBuilder;

CsgTree finish(TreeBuilder& b, CsgNodeId root) {
  CsgTree tree = b.finish(root);
  for (Leaf& leaf : tree.leaves) leaf.bounds = {{0, 0, 0}, {1, 1, 1}};
  return tree;
}

// The leaves that are left to test when these are marked.
std::vector<std::uint32_t> tested(const OperationTree& operations, OperationMarks& marks,
                                  const std::vector<std::uint32_t>& marked) {
  marks.start(operations);
  for (const std::uint32_t leaf : marked) EXPECT_TRUE(marks.mark(operations.node_of(LeafId{leaf})));
  for (const std::uint32_t leaf : marked) EXPECT_FALSE(marks.mark(operations.node_of(LeafId{leaf}))) << "again";
  std::vector<std::uint32_t> leaves;
  marks.for_each_leaf([&](LeafId leaf) { leaves.push_back(leaf.get()); });
  std::sort(leaves.begin(), leaves.end());
  return leaves;
}

using Leaves = std::vector<std::uint32_t>;

TEST(OperationTree, ChildrenLieNextToEachOtherAndBehindTheirParent) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf(), z = b.leaf(), w = b.leaf();
  const CsgTree tree = finish(b, b.unite({b.subtract({b.subtract({x, y}), b.unite({z})}), w}));
  const OperationTree operations(tree);
  ASSERT_EQ(operations.nodes().size(), 6u) << "(x - y) - z is one difference";
  for (std::uint32_t i = 0; i < operations.nodes().size(); ++i) {
    const OperationNode& node = operations.nodes()[i];
    if (node.is_leaf()) continue;
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      EXPECT_GT(node.first_child + c, i);
      EXPECT_EQ(operations.nodes()[node.first_child + c].parent, i);
    }
  }
}

TEST(OperationMarks, UnmarkedBranchesAreLeftOut) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf(), z = b.leaf(), p = b.leaf(), q = b.leaf();
  const CsgTree tree = finish(b, b.unite({b.subtract({x, y, z}), b.intersect({p, q})}));
  const OperationTree operations(tree), plain(tree, false);
  OperationMarks marks;
  EXPECT_EQ(tested(operations, marks, {}), Leaves{});
  EXPECT_EQ(tested(operations, marks, {0, 2}), (Leaves{0, 2}));
  EXPECT_EQ(tested(operations, marks, {1, 2}), Leaves{}) << "tools without what they cut";
  EXPECT_EQ(tested(operations, marks, {2, 3, 0}), (Leaves{0, 2})) << "one operand of an intersection";
  EXPECT_EQ(tested(operations, marks, {4, 3}), (Leaves{3, 4}));
  EXPECT_EQ(tested(plain, marks, {1, 3}), (Leaves{1, 3})) << "as the pseudo code has it";
}

TEST(OperationMarks, WhatMayBeFullUnmarkedIsNotWaitedFor) {
  TreeBuilder b;
  const CsgNodeId half_space = b.leaf(), tool = b.leaf(), p = b.leaf(), q = b.leaf();
  CsgTree tree = finish(b, b.unite({b.subtract({half_space, tool}), b.intersect({b.complement(p), q})}));
  tree.leaves[0].bounds = Box3::everything();
  const OperationTree operations(tree);
  OperationMarks marks;
  EXPECT_EQ(tested(operations, marks, {1}), (Leaves{1})) << "the half-space is revealed without a mark";
  EXPECT_EQ(tested(operations, marks, {3}), (Leaves{3})) << "the complement is full where nothing is met";
  EXPECT_EQ(tested(operations, marks, {2}), Leaves{});
}

// What is left out must not matter: whatever the marked leaves hold, the root is the same with and without the others.
TEST(OperationMarks, WhatIsLeftOutChangesNothing) {
  std::mt19937_64 rng(1);
  OperationMarks marks;
  std::size_t left_out = 0;
  for (int round = 0; round < 300; ++round) {
    TreeBuilder b;
    const int count = 1 + static_cast<int>(rng() % 12);
    const CsgNodeId root = made_up::random_subtree(b, rng, count);
    const CsgTree tree = finish(b, root);
    const OperationTree operations(tree);
    for (int ray = 0; ray < 30; ++ray) {
      Leaves marked;
      for (std::uint32_t i = 0; i < tree.leaves.size(); ++i) {
        if (rng() % 2 == 0) marked.push_back(i);
      }
      const Leaves kept = tested(operations, marks, marked);
      left_out += marked.size() - kept.size();
      std::vector<bool> all(tree.leaves.size()), some(tree.leaves.size());
      for (const std::uint32_t leaf : marked) {
        all[leaf] = rng() % 2 == 0;
        some[leaf] = all[leaf] && std::binary_search(kept.begin(), kept.end(), leaf);
      }
      EXPECT_EQ(made_up::holds(tree, root, all), made_up::holds(tree, root, some));
    }
  }
  EXPECT_GT(left_out, 1000u);
}

TEST(OperationTree, NoDepthOverflowsTheStack) {
  TreeBuilder b;
  CsgNodeId root = b.leaf();
  for (int i = 0; i < 100000; ++i) root = i % 2 == 0 ? b.unite({root, b.leaf()}) : b.subtract({root, b.leaf()});
  const CsgTree tree = finish(b, root);
  const OperationTree operations(tree);
  OperationMarks marks;
  EXPECT_EQ(tested(operations, marks, {0, 100000}), (Leaves{0, 100000}));
}

}  // namespace
}  // namespace tenon
