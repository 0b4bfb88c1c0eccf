#include "plane/offset.h"

#include <gtest/gtest.h>

#include "plane/boundary.h"
#include "support/random_outline.h"

namespace tenon {
namespace {

TEST(Offset, ByARadiusTakesThePointsWithinIt) {
  Random random(20240612);
  int near = 0, near_wrong = 0;
  for (int round = 0; round < 120; ++round) {
    SCOPED_TRACE(round);
    RandomOutline outlines(random, random.uniform(0.5, 2));
    const Outline outline = resolve(Shape::of(outlines.draw()));
    if (outline.loops.empty()) continue;
    const OutlineEdges edges(outline);
    const double distance = random.uniform(-0.3, 0.6), size = length(edges.reach()) + std::fabs(distance);
    const Outline moved = offset(outline, distance, OffsetJoin::round);
    const OutlineEdges moved_edges(moved);
    std::vector<Vec2> points = points_beside(moved, 1e-6 * size);
    for (int i = 0; i < 200; ++i) points.push_back({random.uniform(-size, size), random.uniform(-size, size)});
    for (const Vec2& p : points) {
      const double away = distance_to_boundary(edges, p);
      if (std::fabs(away - std::fabs(distance)) < 5e-7 * size) continue;
      const bool inside = edges.contains(p);
      const bool expected = distance > 0 ? inside || away < distance : inside && away > -distance;
      const bool found = !moved.loops.empty() && moved_edges.contains(p);
      if (std::fabs(away - std::fabs(distance)) > 0x1p-14 * size) {
        EXPECT_EQ(found, expected) << p.x << ' ' << p.y << " moved by " << distance;
      } else {
        ++near;
        near_wrong += found != expected;
      }
    }
  }
  // Boundaries that are nearer to one another than chords can tell are rare.
  EXPECT_GT(near, 1000);
  EXPECT_LE(near_wrong, near / 1000);
}

const Outline square{{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}}};
const Outline circle{{{{0, -3, 1}, {0, 3, 1}}}};

TEST(Offset, OfACircleIsACircle) {
  for (const OffsetJoin join : {OffsetJoin::round, OffsetJoin::miter, OffsetJoin::chamfer}) {
    EXPECT_EQ(offset(circle, 2, join), (Outline{{{{0, -5, 1}, {0, 5, 1}}}}));
    EXPECT_EQ(offset(circle, -1, join), (Outline{{{{0, -2, 1}, {0, 2, 1}}}}));
    EXPECT_TRUE(offset(circle, -3, join).loops.empty());
  }
}

TEST(Offset, JoinsCorners) {
  const OutlineEdges round(offset(square, 1, OffsetJoin::round)), miter(offset(square, 1, OffsetJoin::miter)),
      chamfer(offset(square, 1, OffsetJoin::chamfer));
  EXPECT_EQ(round.edges().size(), 8u);
  EXPECT_EQ(miter.edges().size(), 4u);
  EXPECT_EQ(chamfer.edges().size(), 8u);
  EXPECT_TRUE(miter.contains({-0.999, -0.999}));
  // The chamfer's edge stands 1 from the corner, across the diagonal.
  const double at = std::sqrt(0.5);
  EXPECT_TRUE(chamfer.contains({-at + 1e-9, -at + 1e-9}));
  EXPECT_FALSE(chamfer.contains({-at - 1e-9, -at - 1e-9}));
  for (const OffsetJoin join : {OffsetJoin::round, OffsetJoin::miter, OffsetJoin::chamfer}) {
    const OutlineEdges inward(offset(square, -1, join));
    EXPECT_EQ(inward.edges().size(), 4u);
    EXPECT_TRUE(inward.contains({1.001, 1.001}));
    EXPECT_FALSE(inward.contains({0.999, 2}));
  }
}

TEST(Offset, ClosesHolesAndNotches) {
  const Outline frame{{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}, {{4, 4, 0}, {4, 5, 0}, {5, 5, 0}, {5, 4, 0}}}};
  EXPECT_EQ(offset(frame, 0.4, OffsetJoin::round).loops.size(), 2u);
  EXPECT_EQ(offset(frame, 0.5, OffsetJoin::round).loops.size(), 1u);
  EXPECT_TRUE(offset(frame, -4, OffsetJoin::round).loops.empty());
}

}  // namespace
}  // namespace tenon
