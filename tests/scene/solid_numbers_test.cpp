#include "scene/solid_numbers.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"

namespace tenon {
namespace {

using fixtures::SceneBuilder;
using Numbers = std::vector<std::uint32_t>;

TEST(SolidNumbers, OperandsOfUnionsAreSolidsAndToolsBelongToThem) {
  SceneBuilder b;
  const auto cut = b.subtract({b.sphere(1), b.unite({b.sphere(2), b.sphere(3)})});
  const auto tree =
      b.tree(b.unite({b.sphere(4), b.unite({cut, b.sphere(5)}), b.intersect({b.sphere(6), b.sphere(7)})}));
  EXPECT_EQ(solid_numbers(tree, false), (Numbers{0, 1, 1, 1, 2, 3, 3}));
}

TEST(SolidNumbers, OneSolidWithoutAUnion) {
  SceneBuilder lone, cut;
  EXPECT_EQ(solid_numbers(lone.tree(lone.sphere(1)), false), Numbers{0});
  const auto tool = cut.unite({cut.sphere(2), cut.sphere(3)});
  EXPECT_EQ(solid_numbers(cut.tree(cut.subtract({cut.sphere(1), tool})), false), (Numbers{0, 0, 0}));
}

TEST(SolidNumbers, SectionLeavesTheSolidsApart) {
  SceneBuilder b;
  const auto scene = b.unite({b.sphere(1), b.sphere(2)});
  EXPECT_EQ(solid_numbers(b.tree(b.subtract({scene, b.sphere(3)})), true), (Numbers{0, 1, 2}));
}

}  // namespace
}  // namespace tenon
