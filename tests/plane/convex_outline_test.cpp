#include "plane/convex_outline.h"

#include <gtest/gtest.h>

#include "plane/boundary.h"
#include "support/random_outline.h"

namespace tenon {
namespace {

TEST(ConvexHull, ReachesAsFarAsItsOutlines) {
  Random random(20240613);
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    RandomOutline outlines(random, random.uniform(0.5, 2));
    const Outline outline = outlines.draw();
    const Outline hull = convex_hull(outline);
    ASSERT_EQ(hull.loops.size(), 1u);
    const OutlineEdges edges(outline), hull_edges(hull);
    const double size = length(edges.reach());
    for (int i = 0; i < 100; ++i) {
      const double angle = random.uniform(-4, 4);
      const Vec2 n{std::cos(angle), std::sin(angle)};
      EXPECT_NEAR(support(hull_edges, n), support(edges, n), 1e-9 * size) << angle;
    }
    // It is convex: along every edge it turns to the left, and at every corner.
    const auto& loop = hull.loops[0];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      EXPECT_GE(loop[i].bulge, 0);
      const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()], &c = loop[(i + 2) % loop.size()];
      const Vec2 first{b.x - a.x, b.y - a.y}, second{c.x - b.x, c.y - b.y};
      EXPECT_GE(cross(first, second), -1e-9 * size * size);
    }
  }
}

TEST(ConvexHull, OfCirclesHasTangents) {
  // Of equal size, side by side: a slot.
  const Outline two{{{{0, -1, 1}, {0, 1, 1}}, {{5, -1, 1}, {5, 1, 1}}}};
  const Outline slot = convex_hull(two);
  ASSERT_EQ(slot.loops[0].size(), 4u);
  for (const OutlineCorner& c : slot.loops[0]) {
    EXPECT_NEAR(std::fabs(c.y), 1, 1e-15);
    EXPECT_TRUE(c.bulge == 0 || std::fabs(c.bulge - 1) < 1e-14) << c.bulge;
  }
  // A small one within a large one adds nothing.
  const Outline large{{{{0, -3, 1}, {0, 3, 1}}}};
  EXPECT_EQ(convex_hull({{large.loops[0], {{1, -1, 1}, {1, 1, 1}}}}), large);
}

TEST(ConvexHull, OfALineIsNothing) {
  EXPECT_TRUE(convex_hull({{{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}}}).loops.empty());
  EXPECT_TRUE(convex_hull({}).loops.empty());
}

}  // namespace
}  // namespace tenon
