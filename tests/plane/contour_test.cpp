#include "plane/contour.h"

#include <gtest/gtest.h>

#include "plane/boundary.h"
#include "support/random_outline.h"

namespace tenon {
namespace {

TEST(Contour, KeepsNearTheBoundary) {
  Random random(20240620);
  for (int round = 0; round < 5; ++round) {
    SCOPED_TRACE(round);
    RandomOutline outlines(random, random.uniform(0.5, 2));
    const Outline outline = outlines.draw();
    const OutlineEdges edges(outline);
    const Outline found = contour([&](const Vec2& p) { return edges.contains(p); }, edges.lower(), edges.upper());
    const OutlineEdges found_edges(found);
    const double size = length(edges.upper() - edges.lower());
    for (const OutlineEdge& edge : found_edges.edges()) {
      EXPECT_LE(distance_to_boundary(edges, edge.from), 1e-9 * size);
    }
    for (int i = 0; i < 500; ++i) {
      const Vec2 p{random.uniform(edges.lower().x, edges.upper().x), random.uniform(edges.lower().y, edges.upper().y)};
      // Nothing is missed but what is thinner than a cell.
      if (distance_to_boundary(edges, p) < size / 256) continue;
      EXPECT_EQ(found_edges.contains(p), edges.contains(p)) << p.x << ' ' << p.y;
    }
  }
}

TEST(Contour, IsFineAtCurvesAndCorners) {
  const Outline shape{{{{-1, -1, 0}, {1, -1, 0.4}, {1, 1, 0}, {-1, 1, 0}}, {{0, -0.5, 1}, {0, 0.5, 1}}}};
  const OutlineEdges edges(shape);
  const OutlineEdges found(contour([&](const Vec2& p) { return edges.contains(p); }, edges.lower(), edges.upper()));
  for (const OutlineEdge& edge : found.edges()) {
    EXPECT_LE(distance_to_boundary(edges, 0.5 * (edge.from + edge.to)), 3e-5);
  }
  EXPECT_TRUE(found.contains({-1 + 1e-3, -1 + 1e-3}));
  EXPECT_FALSE(found.contains({0.3, 0.3}));
}

TEST(Contour, OfNothingIsNothing) {
  EXPECT_TRUE(contour([](const Vec2&) { return false; }, {0, 0}, {1, 1}).loops.empty());
}

}  // namespace
}  // namespace tenon
