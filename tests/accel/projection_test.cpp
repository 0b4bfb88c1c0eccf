#include "accel/projection.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "csg/made_up.h"

namespace tenon {
namespace {

using namespace made_up;  // NOLINT(google-build-using-namespace): the vocabulary of these tests
using Kind = SubtreeToken::Kind;

constexpr Box3 cell{{0, 0, 0}, {1, 1, 1}};
constexpr Box3 elsewhere{{5, 5, 5}, {6, 6, 6}};

// A leaf stands in the cell or not, as `here` says.
Projection projection_of(const std::vector<bool>& here, bool has_media = false) {
  std::vector<Box3> enclosures;
  for (const bool h : here) enclosures.push_back(h ? cell : elsewhere);
  return {enclosures, has_media};
}

Subtree project(const CsgTree& tree, const std::vector<bool>& here, bool has_media = false) {
  return projection_of(here, has_media).project(subtree_of(tree), cell);
}

std::vector<std::uint32_t> leaves_of(const Subtree& tree) {
  std::vector<std::uint32_t> leaves;
  for (const SubtreeToken& token : tree) {
    if (token.is_leaf()) leaves.push_back(token.value);
  }
  return leaves;
}

bool value_of(const Subtree& tree, const std::vector<bool>& inside) {
  std::vector<bool> values;
  for (const SubtreeToken& token : tree) {
    if (token.is_leaf()) {
      values.push_back(inside[token.value] != (token.kind == Kind::complemented_leaf));
    } else if (token.kind == Kind::everything) {
      values.push_back(true);
    } else {
      std::size_t trues = 0;
      for (std::uint32_t i = 0; i < token.value; ++i) {
        trues += values.back();
        values.pop_back();
      }
      values.push_back(token.kind == Kind::union_ ? trues > 0 : trues == token.value);
    }
  }
  return !values.empty() && values.back();
}

// RR-612 §3.2, its table: NL ope NR, where L and R are leaf 0 and leaf 1.
struct Rule {
  CsgOperation ope;
  bool left_here, right_here;
  std::vector<std::uint32_t> left_over;
};

TEST(Projection, FollowsTheRulesOfThePaper) {
  constexpr auto union_ = CsgOperation::union_, difference = CsgOperation::difference,
                 intersection = CsgOperation::intersection;
  const Rule rules[] = {
      {union_, true, true, {0, 1}}, {difference, true, true, {0, 1}}, {intersection, true, true, {0, 1}},
      {union_, false, false, {}},   {difference, false, false, {}},   {intersection, false, false, {}},
      {union_, false, true, {1}},   {difference, false, true, {}},    {intersection, false, true, {}},
      {union_, true, false, {0}},   {difference, true, false, {0}},   {intersection, true, false, {}},
  };
  for (const Rule& rule : rules) {
    TreeBuilder b;
    const CsgNodeId left = b.leaf(), right = b.leaf();
    const CsgTree tree = b.finish(b.operation(rule.ope, {left, right}));
    EXPECT_EQ(leaves_of(project(tree, {rule.left_here, rule.right_here})), rule.left_over)
        << static_cast<int>(rule.ope) << rule.left_here << rule.right_here;
  }
}

TEST(Projection, OfAComplementOfWhatIsNotThereIsEverything) {
  TreeBuilder b;
  const CsgNodeId a = b.leaf(), c = b.leaf();
  const CsgTree tree = b.finish(b.unite({b.complement(a), c}));
  EXPECT_EQ(project(tree, {false, true}), (Subtree{{Kind::everything, 0}}));
  // Where media are told apart, what lies inside the other operand is its medium.
  EXPECT_EQ(leaves_of(project(tree, {false, true}, true)), std::vector<std::uint32_t>{1});
}

TEST(Projection, HasTheValueOfTheWholeTreeWhateverIsDropped) {
  std::mt19937_64 rng(612);
  for (int round = 0; round < 2000; ++round) {
    TreeBuilder b;
    const std::size_t n = 1 + rng() % 9;
    const CsgNodeId root = random_subtree(b, rng, static_cast<int>(n));
    const CsgTree tree = b.finish(root);
    std::vector<bool> here(n);
    for (std::size_t i = 0; i < n; ++i) here[i] = rng() % 2 == 0;
    const Subtree whole = subtree_of(tree);
    const Subtree projected = project(tree, here, round % 2 == 0);
    ASSERT_LE(projected.size(), whole.size());
    for (std::uint64_t state = 0; state < (1u << n); ++state) {
      std::vector<bool> inside(n), seen(n);
      const std::vector<std::uint32_t> kept = leaves_of(projected);
      for (std::size_t i = 0; i < n; ++i) {
        inside[i] = here[i] && ((state >> i) & 1) != 0;
        seen[i] = inside[i] && std::find(kept.begin(), kept.end(), i) != kept.end();
      }
      ASSERT_EQ(value_of(projected, inside), holds(tree, root, inside));
      ASSERT_EQ(value_of(whole, inside), holds(tree, root, inside));
      // The whole tree does not care for leaves that were dropped: a structure need not reveal them.
      ASSERT_EQ(holds(tree, root, seen), holds(tree, root, inside));
    }
  }
}

TEST(Projection, OfAProjectionIsThatOfTheWhole) {
  std::mt19937_64 rng(613);
  for (int round = 0; round < 500; ++round) {
    TreeBuilder b;
    const std::size_t n = 1 + rng() % 12;
    const CsgTree tree = b.finish(random_subtree(b, rng, static_cast<int>(n)));
    std::vector<bool> here(n), nearer(n);
    for (std::size_t i = 0; i < n; ++i) {
      here[i] = rng() % 3 != 0;
      nearer[i] = here[i] && rng() % 2 == 0;
    }
    const Subtree once = project(tree, nearer);
    EXPECT_EQ(projection_of(nearer).project(project(tree, here), cell), once);
  }
}

TEST(Projection, EnclosesWhereTheSubtreeMayBeTrue) {
  const Box3 left{{0, 0, 0}, {0.5, 1, 1}}, middle{{0.25, 0, 0}, {0.75, 1, 1}};
  Projection projection({left, middle}, false);
  const auto enclose = [&](CsgOperation op) {
    TreeBuilder b;
    const CsgNodeId l = b.leaf(), m = b.leaf();
    return projection.enclose(subtree_of(b.finish(b.operation(op, {l, m}))), cell);
  };
  EXPECT_EQ(enclose(CsgOperation::union_), hull(left, middle));
  EXPECT_EQ(enclose(CsgOperation::intersection), intersection(left, middle));
  EXPECT_EQ(enclose(CsgOperation::difference), left);
  EXPECT_TRUE(projection.enclose({}, cell).is_empty());
}

TEST(Projection, OfADeepChainNeedsNoDeepStack) {
  TreeBuilder b;
  CsgNodeId chain = b.leaf();
  for (int i = 0; i < 100000; ++i) {
    chain = i % 2 == 0 ? b.subtract({chain, b.leaf()}) : b.unite({chain, b.leaf()});
  }
  const CsgTree tree = b.finish(chain);
  std::vector<bool> here(tree.leaves.size(), false);
  here[0] = here[99998] = true;
  EXPECT_EQ(leaves_of(project(tree, here)), (std::vector<std::uint32_t>{0, 99998}));
}

}  // namespace
}  // namespace tenon
