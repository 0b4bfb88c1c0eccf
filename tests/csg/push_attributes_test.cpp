#include "csg/push_attributes.h"

#include <gtest/gtest.h>

#include "csg/minimum_enclosure.h"
#include "support/scene_builder.h"

namespace tenon {
namespace {

using fixtures::SceneBuilder;

void expect_near(const Box3& box, const Vec3& lower, const Vec3& upper) {
  const double rounding = 1e-14 * (1 + box.largest_coordinate());  // a few units in the last place of the corners
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.lower[axis], lower[axis], rounding);
    EXPECT_NEAR(box.upper[axis], upper[axis], rounding);
  }
}

TEST(PushAttributes, MultipliesTransformationsDownToTheLeaves) {
  SceneBuilder b;
  const SceneNodeId moved = b.translate({1, 0, 0}, b.rotate({0, 0, 90}, b.translate({2, 0, 0}, b.cube({1, 1, 1}))));
  const CsgTree tree = b.tree(moved);
  ASSERT_EQ(tree.leaves.size(), 1u);
  expect_near(tree.leaves[0].bounds, {0, 2, 0}, {1, 3, 1});
}

TEST(PushAttributes, NumbersLeavesInTreeOrder) {
  SceneBuilder b;
  const SceneNodeId tool = b.unite({b.sphere(2), b.sphere(3)});
  const CsgTree tree = b.tree(b.subtract({b.sphere(1), tool, b.sphere(4)}));
  ASSERT_EQ(tree.leaves.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(tree.primitives.values(tree.leaves[i].primitive)[0], FieldValue{static_cast<double>(i + 1)});
  }
}

// A surface has no inside that could be taken away; under two complements it clips like any other.
TEST(PushAttributes, LeavesOutSurfacesThatAreSubtracted) {
  for (const std::string_view kind : {"polygon3d", "bicubic"}) {
    const auto surface = [kind](SceneBuilder& b) {
      std::vector<FieldValue> values;
      for (const FieldInfo& field : PrimitiveStore::find_kind(kind)->fields) values.push_back(field.fallback);
      return b.primitive(kind, values);
    };
    SceneBuilder once, twice;
    Diagnostics diagnostics;
    CsgTree tree = push_attributes(once.finish(once.subtract({once.sphere(1), surface(once)})), diagnostics);
    EXPECT_EQ(tree.leaves.size(), 1u);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    EXPECT_NE(diagnostics.warnings()[0].find("1 surface is subtracted"), std::string::npos);

    const SceneNodeId inner = twice.subtract({twice.sphere(2), surface(twice)});
    Diagnostics none;
    tree = push_attributes(twice.finish(twice.subtract({twice.sphere(3), inner})), none);
    EXPECT_EQ(tree.leaves.size(), 3u);
    EXPECT_TRUE(none.warnings().empty());
  }
}

TEST(PushAttributes, ASharedSubtreeBecomesALeafForEachPlace) {
  SceneBuilder b;
  const SceneNodeId ball = b.sphere(1);
  const CsgTree tree = b.tree(b.unite({ball, b.translate({5, 0, 0}, ball)}));
  ASSERT_EQ(tree.leaves.size(), 2u);
  expect_near(tree.leaves[1].bounds, {4, -1, -1}, {6, 1, 1});
}

TEST(PushAttributes, WhatAMapFlattensIsLeftOutWithAWarning) {
  SceneBuilder b;
  SceneGraph graph = b.finish(b.unite({b.sphere(1), b.transform(Affine3::scale({1, 1, 0}), b.sphere(1))}));
  Diagnostics diagnostics;
  const CsgTree tree = push_attributes(std::move(graph), diagnostics);
  EXPECT_EQ(tree.leaves.size(), 1u);
  EXPECT_EQ(diagnostics.warnings().size(), 1u);
}

TEST(PushAttributes, NoDepthOverflowsTheStack) {
  SceneBuilder b;
  SceneNodeId shell = b.sphere(1);
  for (int i = 0; i < 100000; ++i) shell = b.unite({b.sphere(1), b.scale(0.9999, b.rotate({0, 0, 12}, shell))});
  const CsgTree tree = b.tree(shell);
  EXPECT_EQ(tree.leaves.size(), 100001u);
  EXPECT_EQ(tree.depth(), 100001);
  const auto minimum = minimum_enclosures(tree, node_enclosures(tree));
  EXPECT_EQ(minimum.size(), tree.leaves.size());
}

// RR-612, figures 1 and 2: an operand of an intersection is cut to the other's box, and by every box further up.
TEST(MinimumEnclosure, IsCutByTheEnclosuresOfEveryNodeAbove) {
  SceneBuilder b;
  const SceneNodeId p1 = b.box({0, 0, 0}, {10, 10, 10}), p2 = b.box({4, 0, 0}, {14, 10, 10});
  const SceneNodeId p3 = b.box({0, 6, 0}, {20, 20, 10});
  const CsgTree tree = b.tree(b.intersect({b.intersect({p1, p2}), p3}));
  const auto minimum = minimum_enclosures(tree, node_enclosures(tree));
  for (const Box3& box : minimum) expect_near(box, {4, 6, 0}, {10, 10, 10});
}

TEST(MinimumEnclosure, AToolIsCutToTheMinuendAndNotTheOtherWayRound) {
  SceneBuilder b;
  const CsgTree tree = b.tree(b.subtract({b.box({0, 0, 0}, {4, 4, 4}), b.box({3, 3, 3}, {9, 9, 9})}));
  const auto minimum = minimum_enclosures(tree, node_enclosures(tree));
  expect_near(minimum[0], {0, 0, 0}, {4, 4, 4});
  expect_near(minimum[1], {3, 3, 3}, {4, 4, 4});
}

TEST(MinimumEnclosure, ASubtractedHalfSpaceAlongAnAxisCutsTheMinuend) {
  const auto enclosure = [](const Vec3& normal, double d) {
    SceneBuilder b;
    const SceneNodeId half_space = b.primitive("halfspace", {normal, d});
    const CsgTree tree = b.tree(b.subtract({b.box({0, 0, 0}, {4, 4, 4}), half_space}));
    return node_enclosures(tree)[tree.root.get()];
  };
  expect_near(enclosure({0, 0, -2}, -2), {0, 0, 0}, {4, 4, 1});
  expect_near(enclosure({1, 0, 0}, 3), {3, 0, 0}, {4, 4, 4});
  expect_near(enclosure({1, 1, 0}, 3), {0, 0, 0}, {4, 4, 4});
  EXPECT_TRUE(enclosure({1, 0, 0}, 5).is_empty());
}

TEST(MinimumEnclosure, AUnionCutsNothing) {
  SceneBuilder b;
  const CsgTree tree = b.tree(b.unite({b.box({0, 0, 0}, {1, 1, 1}), b.box({5, 5, 5}, {6, 6, 6})}));
  const auto minimum = minimum_enclosures(tree, node_enclosures(tree));
  expect_near(minimum[0], {0, 0, 0}, {1, 1, 1});
  expect_near(minimum[1], {5, 5, 5}, {6, 6, 6});
}

}  // namespace
}  // namespace tenon
