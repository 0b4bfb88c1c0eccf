#include "plane/minkowski.h"

#include <gtest/gtest.h>

#include "plane/boundary.h"
#include "plane/convex_outline.h"
#include "support/random_outline.h"

namespace tenon {
namespace {

Outline random_convex(Random& random) {
  RandomOutline outlines(random, random.uniform(0.5, 2));
  return convex_hull(outlines.draw());
}

TEST(MinkowskiSum, OfConvexOutlinesAddsTheirSupports) {
  Random random(20240617);
  for (int round = 0; round < 200; ++round) {
    SCOPED_TRACE(round);
    const Outline a = random_convex(random), b = random_convex(random);
    ASSERT_TRUE(is_convex(a) && is_convex(b));
    const Result<Outline> sum = minkowski_sum(a, b);
    ASSERT_TRUE(sum.ok());
    EXPECT_TRUE(is_convex(*sum));
    const OutlineEdges edges_a(a), edges_b(b), edges(*sum);
    const double size = length(edges_a.reach()) + length(edges_b.reach());
    for (int i = 0; i < 100; ++i) {
      const double angle = random.uniform(-4, 4);
      const Vec2 n{std::cos(angle), std::sin(angle)};
      EXPECT_NEAR(support(edges, n), support(edges_a, n) + support(edges_b, n), 1e-9 * size) << angle;
    }
  }
}

bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}

Outline star(Random& random) {
  Outline outline;
  const int n = 3 + random.below(6);
  auto& loop = outline.loops.emplace_back();
  for (int i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * i / n, r = random.uniform(0.3, 2);
    loop.push_back({r * std::cos(angle), r * std::sin(angle), 0});
  }
  if (random.chance(0.4)) outline.loops.push_back({{0.1, 0.1, 0}, {-0.1, 0.2, 0}, {0, -0.15, 0}});
  return resolve(Shape::of(outline));
}

// Whether a and the points p - b for b in the other have a point in common: their boundaries cross, or one holds the
// other.
bool meet(const Outline& a, const Outline& b, const Vec2& p) {
  const OutlineEdges edges_a(a), edges_b(b);
  for (const OutlineEdge& e : edges_a.edges()) {
    for (const OutlineEdge& f : edges_b.edges()) {
      if (cross_each_other(e.from, e.to, p - f.from, p - f.to)) return true;
    }
  }
  const auto first = [](const std::vector<OutlineCorner>& loop) { return Vec2{loop.front().x, loop.front().y}; };
  const auto holds = [&](const OutlineEdges& one, const Outline& other) {
    return std::any_of(other.loops.begin(), other.loops.end(),
                       [&](const auto& loop) { return one.contains(p - first(loop)); });
  };
  return holds(edges_a, b) || holds(edges_b, a);
}

TEST(MinkowskiSum, OfPolygonsHoldsEverySum) {
  Random random(20240618);
  int inside = 0, outside = 0;
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    const Outline a = star(random), b = star(random);
    const Result<Outline> sum = minkowski_sum(a, b);
    ASSERT_TRUE(sum.ok());
    const OutlineEdges edges(*sum);
    for (int i = 0; i < 100; ++i) {
      const Vec2 p{random.uniform(-4, 4), random.uniform(-4, 4)};
      if (distance_to_boundary(edges, p) < 1e-9) continue;
      const bool expected = meet(a, b, p);
      EXPECT_EQ(edges.contains(p), expected) << p.x << ' ' << p.y;
      ++(expected ? inside : outside);
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 500);
}

TEST(MinkowskiSum, WithACircleIsAnOffset) {
  const Outline notched{{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}}}}, circle{{{{1, -1, 1}, {1, 1, 1}}}};
  const OutlineEdges sum(*minkowski_sum(notched, circle)), other(*minkowski_sum(circle, notched));
  EXPECT_TRUE(sum.contains({1 + 4 + 0.999, 2}));
  EXPECT_FALSE(sum.contains({1 + 4 + 1.001, 2}));
  EXPECT_EQ(sum.edges().size(), other.edges().size());
  EXPECT_TRUE(std::any_of(sum.edges().begin(), sum.edges().end(), [](const OutlineEdge& e) { return e.is_arc(); }));
}

TEST(MinkowskiSum, RefusesTooManyEdges) {
  Outline comb;
  auto& loop = comb.loops.emplace_back();
  for (int i = 0; i < 500; ++i) {
    loop.push_back({2.0 * i, 0, 0});
    loop.push_back({2.0 * i + 1, 5, 0});
  }
  loop.push_back({1000, -1, 0});
  loop.push_back({0, -1, 0});
  EXPECT_FALSE(minkowski_sum(comb, comb).ok());
}

}  // namespace
}  // namespace tenon
