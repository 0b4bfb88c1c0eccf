#include <gtest/gtest.h>

#include "accel/cells_checks.h"
#include "csg/prototype.h"
#include "support/instruction_sets.h"

namespace tenon {
namespace {

using fixtures::Draw;
using fixtures::SceneBuilder;
using namespace cells_checks;

// A part of all kinds of leaf, with faces that are flush and edges that are cut.
SceneNodeId bracket(SceneBuilder& b) {
  const Outline angle{{{{0, 0, 0}, {0.9, 0, 0}, {0.9, 0.2, 0}, {0.3, 0.3, 0}, {0.3, 0.5, 0}, {0, 0.5, 0}}}};
  return b.unite({b.subtract({b.cube({2, 1, 1}), b.translate({0.5, 0.5, -1}, b.cylinder(3, 0.3)),
                              b.translate({1, 0, 0.5}, b.cube({1, 1, 0.5})), b.translate({2, 1, 0.5}, b.sphere(0.4)),
                              b.rotate({0, 0, 45}, b.cube({0.4, 0.4, 3}, true))}),
                  b.translate({1.5, 0.5, 0.5}, b.primitive("cone", {0.5, 0.3, 0.1, false})),
                  b.translate({1.05, 0, 0.5}, b.primitive("prism", {angle, 0.3, false, 1.0})),
                  b.translate({0.5, 0.5, 1}, b.torus(0.35, 0.1)), b.translate({0, 0, 1}, b.cube({0.2, 1, 0.25}))});
}

void expect_right(const CsgTree& tree, int rounds = 200, double least_hits = 0.1) {
  ASSERT_FALSE(tree.prototypes.empty());
  expect_same_answers(tree, "cells", rounds, least_hits);
  expect_streams_say_what_single_rays_say(tree, 5000);
}

// Copies apart from one another, on a plate, in all directions, mirrored, and turned about.
TEST(CellsInstances, ThatStandApart) {
  SceneBuilder b;
  const SceneNodeId part = bracket(b);
  Draw draw(71);
  std::vector<SceneNodeId> parts{b.translate({-2, -2, -0.5}, b.cube({22, 22, 0.5}))};
  for (int i = 0; i < 36; ++i) {
    const Vec3 place{3.5 * (i % 6), 3.5 * (i / 6 % 6), draw.real(0, 0.5)};
    const SceneNodeId turned = b.rotate({0, 0, i % 3 == 0 ? 90.0 * (i % 4) : draw.real(0, 360)}, part);
    parts.push_back(b.translate(place, i % 5 == 0 ? b.transform(Affine3::scale({1, -1, 1}), turned) : turned));
  }
  const CsgTree tree = b.instanced_tree(b.unite(parts));
  expect_right(tree);
  for_each_instruction_set([&] { expect_streams_say_what_single_rays_say(tree, 500); });
}

// Flush with one another and with what cuts them, and through one another.
SceneNodeId row_of_brackets(SceneBuilder& b, SceneNodeId part) {
  std::vector<SceneNodeId> row;
  for (int i = 0; i < 12; ++i) row.push_back(b.translate({2.0 * (i % 4), 1.0 * (i / 4), 0}, part));
  row.push_back(b.translate({0.3, 0.2, -0.4}, part));
  row.push_back(b.translate({4, 1, 0.5}, b.rotate({30, 40, 50}, part)));
  return b.unite(row);
}

TEST(CellsInstances, ThatTouchAndOverlap) {
  {
    SceneBuilder b;
    const SceneNodeId part = bracket(b);
    const SceneNodeId cut =
        b.subtract({row_of_brackets(b, part), b.translate({3, 1, 0.5}, b.cube({2, 3, 2})),
                    b.translate({6, 2.5, 0}, part), b.translate({-1, -0.5, -1}, b.cube({4, 1, 3}))});
    expect_right(b.instanced_tree(b.unite({cut, b.translate({2, 1, 1}, b.sphere(0.75))})), 400);
  }
  SceneBuilder b;
  const SceneNodeId row = row_of_brackets(b, bracket(b));
  expect_right(b.instanced_tree(b.intersect({row, b.translate({4, 1.5, 0.5}, b.sphere(2.5))})), 300);
}

// So far from one another that what the scene takes for one place is large against a part, and its walls are no
// thicker.
TEST(CellsInstances, ThatAreSmallInTheirScene) {
  for (const double step : {60.0, 3000.0}) {
    SCOPED_TRACE(step);
    SceneBuilder b;
    const SceneNodeId shell = b.subtract({b.sphere(0.6), b.sphere(0.6 - 1e-5)});
    const SceneNodeId part = b.unite({bracket(b), b.translate({0.5, -1, 0.5}, shell)});
    std::vector<SceneNodeId> parts;
    for (int i = 0; i < 16; ++i) {
      parts.push_back(b.translate({step * (i % 4), step * (i / 4), 0}, b.rotate({7.0 * i, 0, 5.0 * i}, part)));
    }
    const CsgTree tree = b.instanced_tree(b.unite(parts));
    ASSERT_FALSE(tree.prototypes.empty());
    const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
    Draw draw(72);
    battery::RaySet rays;
    for (int i = 0; i < 10000; ++i) {
      const Vec3 aim = Vec3{step * (i % 4), step * (i / 4 % 4), 0} + 2 * draw.direction();
      const Vec3 from = aim + draw.real(3, 2 * step) * draw.direction();
      rays.add(from, aim - from);
    }
    const battery::Verdict verdict = battery::judge(**none, **judged, rays);
    EXPECT_EQ(verdict.mismatches, 0u) << verdict.first;
    EXPECT_GT(verdict.hits, 1000u);
  }
}

// Copies of different sizes, stretched, and sheared.
TEST(CellsInstances, ThatAreStretched) {
  SceneBuilder b;
  const SceneNodeId part = bracket(b);
  Draw draw(73);
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 20; ++i) {
    const double size = std::ldexp(1.0, i % 5 - 2);
    const Affine3 shear{{{{1, draw.real(-0.3, 0.3), 0, 0}, {0, 1, draw.real(-0.3, 0.3), 0}, {0, 0, 1, 0}}}};
    const Affine3 stretch = Affine3::scale({size, size * (i % 3 == 0 ? 2 : 1), size});
    const SceneNodeId placed = b.transform(i % 2 == 0 ? shear : stretch, b.rotate({0, 30.0 * i, 0}, part));
    parts.push_back(b.translate({6.0 * (i % 5), 6.0 * (i / 5), draw.real(-1, 1)}, placed));
  }
  expect_right(b.instanced_tree(b.unite(parts)), 400);
}

// Parts that are made of parts.
TEST(CellsInstances, ThatAreMadeOfInstances) {
  SceneBuilder b;
  const SceneNodeId part = bracket(b);
  const SceneNodeId pair =
      b.unite({part, b.translate({2, 0.5, 0}, b.scale(0.5, part)), b.translate({0, -1.5, 0}, part)});
  const SceneNodeId group = b.subtract({b.unite({pair, b.translate({4, 0, 0}, pair), b.translate({0, 3, 0}, pair),
                                                 b.translate({4, 3, 0.25}, b.rotate({0, 0, 10}, pair))}),
                                        b.translate({2, 2, 0.5}, b.cylinder(3, 0.8, true))});
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 9; ++i) {
    parts.push_back(b.translate({9.0 * (i % 3), 9.0 * (i / 3), 0}, b.rotate({0, 0, 10.0 * i}, group)));
  }
  const CsgTree tree = b.instanced_tree(b.unite(parts));
  ASSERT_FALSE(tree.prototypes.empty());
  expect_right(tree, 300);
}

// A part of which its tools leave nothing, beside one of which they leave something.
TEST(CellsInstances, OfWhichNothingIsLeft) {
  SceneBuilder b;
  const SceneNodeId part = bracket(b);
  const SceneNodeId gone = b.subtract({bracket(b), b.translate({-1, -1, -1}, b.cube({5, 5, 5})), b.sphere(0.5)});
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 9; ++i) {
    parts.push_back(b.translate({3.0 * (i % 3), 3.0 * (i / 3), 0}, gone));
    parts.push_back(b.translate({3.0 * (i % 3), 3.0 * (i / 3), i % 2 == 0 ? 0.5 : 2.0}, part));
  }
  const CsgTree tree = b.instanced_tree(b.unite(parts));
  ASSERT_EQ(tree.prototypes.size(), 2u);
  expect_right(tree);
}

// A ray through a part visits cells of its own, and asks few of its many leaves.
TEST(CellsInstances, AreFollowedThroughTheirOwnCells) {
  SceneBuilder b;
  std::vector<SceneNodeId> holes{b.cube({10, 10, 1})};
  for (int i = 0; i < 100; ++i) holes.push_back(b.translate({0.5 + i % 10, 0.5 + i / 10, 1}, b.sphere(0.4)));
  const SceneNodeId part = b.subtract(holes);
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 8; ++i) parts.push_back(b.translate({12.0 * i, 0, 0}, part));
  const CsgTree tree = b.instanced_tree(b.unite(parts));
  ASSERT_EQ(tree.leaves.size(), 8u);
  const auto cells = build_accelerator("cells", tree);
  const auto context = (*cells)->make_context();
  Draw draw(74);
  constexpr int rays = 1000;
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    RayQuery query;
    query.ray = {{draw.real(0, 94), draw.real(0, 10), 5}, {draw.real(-0.2, 0.2), draw.real(-0.2, 0.2), -1}};
    hits += (*cells)->first_hit(query, *context).found();
  }
  EXPECT_GT(hits, rays / 2);
  const TraversalCounters& counters = context->statistics[RayKind::primary];
  EXPECT_GT(counters.cells_visited, 2u * static_cast<unsigned>(hits)) << "those of the scene and of the part";
  EXPECT_LT(counters.primitive_tests, 6u * rays);
}

}  // namespace
}  // namespace tenon
