#include "mesh/self_intersection.h"

#include <gtest/gtest.h>

#include "support/meshes.h"
#include "support/random.h"

namespace tenon {
namespace {

TEST(SelfIntersection, MeshesThatOnlyTouchThemselvesHaveNone) {
  Random random(3);
  const auto box = meshes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(find_self_intersection(box));
  EXPECT_FALSE(find_self_intersection(meshes::ring(1, 0.4, 9, 7)));
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(find_self_intersection(meshes::star(3, [&](const Vec3&) { return random.uniform(0.2, 1); })));
  }
  // Beside one another with a common face, with a common edge, and one within the other.
  EXPECT_FALSE(find_self_intersection(meshes::together(box, meshes::box({1, 0, 0}, {2, 1, 1}))));
  EXPECT_FALSE(find_self_intersection(meshes::together(box, meshes::box({1, 1, 0.3}, {2, 2, 0.7}))));
  EXPECT_FALSE(find_self_intersection(meshes::together(box, meshes::box({0.2, 0.2, 0.2}, {0.7, 0.7, 0.7}))));
}

TEST(SelfIntersection, PartsThatPassThroughOneAnotherAreFound) {
  Random random(4);
  const auto ball = meshes::star(3, [](const Vec3&) { return 1.0; });
  for (int i = 0; i < 50; ++i) {
    const double apart = random.uniform(0.1, 4);
    const auto other = meshes::scaled(ball, {1, 1, 1}, apart * random.direction());
    const auto found = find_self_intersection(meshes::together(ball, other));
    // The inscribed spheres of the balls have radius 0.98 and more.
    ASSERT_TRUE(found || apart > 1.95) << apart;
    ASSERT_TRUE(!found || apart < 2) << apart;
    if (!found) continue;
    EXPECT_LT(found->first, ball.triangles.size());
    EXPECT_GE(found->second, ball.triangles.size());
    EXPECT_NEAR(length(found->place), 1, 0.03);
  }
}

// However small the part that passes through, and however large the numbers around it.
TEST(SelfIntersection, ATipThroughAFaceIsOnePairOfThree) {
  for (const double depth : {0.5, 1e-3, 1e-9}) {
    TriangleMesh tip;
    tip.vertices = {{0.3, 0.2, 1 - depth}, {0.25, 0.15, 2}, {0.4, 0.15, 2}, {0.3, 0.3, 2}};
    tip.triangles = {{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}};
    const auto found = find_self_intersection(meshes::together(meshes::box({0, 0, 0}, {1, 1, 1}), tip));
    ASSERT_TRUE(found) << depth;
    EXPECT_EQ(found->count, 3u) << depth;
    EXPECT_NEAR(found->place.z, 1, 1e-12);
  }
}

}  // namespace
}  // namespace tenon
