#include "plane/contour.h"

#include <gtest/gtest.h>

#include "plane/boundary.h"
#include "primitive/arc.h"
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
    EXPECT_LE(distance_to_boundary(edges, middle_of_arc(edge.from, edge.to, edge.bulge)), 3e-5);
  }
  // Nine segments and arcs, each corner cut by a short one, and what is too round for one arc.
  EXPECT_LE(found.edges().size(), 60u);
  EXPECT_TRUE(found.contains({-1 + 1e-3, -1 + 1e-3}));
  EXPECT_FALSE(found.contains({0.3, 0.3}));
}

TEST(Contour, OfAnEllipseIsFewArcs) {
  const auto inside = [](const Vec2& p) { return p.x * p.x / 9 + p.y * p.y < 1; };
  const OutlineEdges found(contour(inside, {-3, -1}, {3, 1}));
  EXPECT_LE(found.edges().size(), 120u);
  for (const OutlineEdge& edge : found.edges()) {
    const Vec2 m = middle_of_arc(edge.from, edge.to, edge.bulge);
    EXPECT_NEAR(m.x * m.x / 9 + m.y * m.y, 1, 1e-4);
  }
}

TEST(Contour, OfNothingIsNothing) {
  EXPECT_TRUE(contour([](const Vec2&) { return false; }, {0, 0}, {1, 1}).loops.empty());
}

}  // namespace
}  // namespace tenon
