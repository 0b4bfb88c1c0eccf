#include "csg/expression.h"

#include <gtest/gtest.h>

#include "made_up.h"

namespace tenon {
namespace {

using namespace made_up;  // NOLINT(google-build-using-namespace): the vocabulary of these tests

TEST(Expression, AgreesWithTheTreeForEveryStateOfItsLeaves) {
  std::mt19937_64 rng(7);
  for (int round = 0; round < 300; ++round) {
    TreeBuilder b;
    const int n = 1 + static_cast<int>(rng() % 9);
    const CsgNodeId root = random_subtree(b, rng, n);
    const CsgTree tree = b.finish(root);
    const Expression expression = Expression::compile(tree);
    ExpressionState state(expression);
    state.reset();
    std::vector<bool> inside(static_cast<std::size_t>(n), false);
    ASSERT_EQ(state.value(), holds(tree, root, inside));
    for (int step = 0; step < 100; ++step) {
      const std::size_t leaf = rng() % inside.size();
      inside[leaf] = !inside[leaf];
      ASSERT_EQ(state.flip(LeafId{leaf}), holds(tree, root, inside));
      ASSERT_EQ(state.inside(LeafId{leaf}), inside[leaf]);
    }
  }
}

TEST(Expression, ALopsidedUnionIsOneNode) {
  TreeBuilder b;
  CsgNodeId shell = b.leaf();
  for (int i = 0; i < 100000; ++i) shell = b.unite({shell, b.leaf()});
  const CsgTree tree = b.finish(shell);
  const Expression expression = Expression::compile(tree);
  EXPECT_EQ(expression.nodes.size(), 1u);
  EXPECT_EQ(tree.depth(), 100001);
}

TEST(Expression, ADeepChainOfAlternatingOperationsNeedsNoDeepStack) {
  TreeBuilder b;
  CsgNodeId chain = b.leaf();
  for (int i = 0; i < 100000; ++i) {
    chain = i % 2 == 0 ? b.subtract({chain, b.leaf()}) : b.unite({chain, b.leaf()});
  }
  const CsgTree tree = b.finish(chain);
  const Expression expression = Expression::compile(tree);
  ExpressionState state(expression);
  state.reset();
  EXPECT_TRUE(state.flip(LeafId{0}));
  EXPECT_FALSE(state.flip(LeafId{0}));
}

TEST(Expression, OperationsWithoutOperandsAreConstants) {
  TreeBuilder b;
  const CsgTree nothing = b.finish(b.unite({}));
  EXPECT_FALSE(Expression::compile(nothing).initial_value());
  TreeBuilder b2;
  const CsgTree everything = b2.finish(b2.complement(b2.unite({})));
  EXPECT_TRUE(Expression::compile(everything).initial_value());
  TreeBuilder b3;
  const CsgNodeId leaf = b3.leaf();
  const CsgTree cut = b3.finish(b3.intersect({leaf, b3.unite({})}));
  const Expression expression = Expression::compile(cut);
  ExpressionState state(expression);
  state.reset();
  EXPECT_FALSE(state.flip(LeafId{0}));
}

TEST(Expression, OwnershipGoesToTheMinuendAndNeverToTheTool) {
  TreeBuilder b;
  const CsgNodeId a = b.leaf(), tool = b.leaf(), kept = b.leaf();
  const CsgTree tree = b.finish(b.subtract({a, b.subtract({tool, kept})}));  // a - (tool - kept)
  const Expression expression = Expression::compile(tree);
  ExpressionState state(expression);
  state.reset();
  state.flip(LeafId{0});
  EXPECT_TRUE(state.owns(LeafId{0}));
  state.flip(LeafId{1});
  EXPECT_FALSE(state.value());
  EXPECT_FALSE(state.owns(LeafId{0}));
  state.flip(LeafId{2});
  EXPECT_TRUE(state.value());
  EXPECT_TRUE(state.owns(LeafId{0}));
  EXPECT_FALSE(state.owns(LeafId{1}));
  EXPECT_FALSE(state.owns(LeafId{2})) << "what a tool leaves is the minuend's";
}

TEST(Expression, AComplementOwnsNothingUnlessItIsOneOfAComplement) {
  TreeBuilder b;
  const CsgNodeId a = b.leaf(), tool = b.leaf(), kept = b.leaf(), twice = b.leaf();
  const CsgTree tree = b.finish(b.unite(
      {b.intersect({a, b.complement(b.intersect({tool, b.complement(kept)}))}), b.complement(b.complement(twice))}));
  const Expression expression = Expression::compile(tree);
  ExpressionState state(expression);
  state.reset();
  for (std::size_t i = 0; i < 4; ++i) state.flip(LeafId{i});
  EXPECT_TRUE(state.value());
  EXPECT_TRUE(state.owns(LeafId{0}));
  EXPECT_FALSE(state.owns(LeafId{1}));
  EXPECT_FALSE(state.owns(LeafId{2}));
  EXPECT_TRUE(state.owns(LeafId{3}));
}

}  // namespace
}  // namespace tenon
