// Whether outlines enclose what the expressions say that they were made of.
#include "plane/shape.h"

#include <gtest/gtest.h>

#include "plane/boundary.h"
#include "support/random_outline.h"

namespace tenon {
namespace {

Shape random_shape(Random& random, int depth) {
  if (depth == 0 || random.chance(0.3)) {
    RandomOutline outlines(random, random.uniform(0.5, 2));
    return Shape::of(outlines.draw());
  }
  constexpr Shape::Operation operations[] = {Shape::Operation::unite, Shape::Operation::intersect,
                                             Shape::Operation::subtract};
  Shape shape;
  shape.operation = operations[random.below(3)];
  for (int i = 2 + random.below(2); i > 0; --i) shape.parts.push_back(random_shape(random, depth - 1));
  return shape;
}

bool contains(const Shape& shape, const Vec2& p) {
  const auto part_contains = [&](const Shape& part) { return contains(part, p); };
  switch (shape.operation) {
    case Shape::Operation::outline:
      return OutlineEdges(shape.outline).contains(p);
    case Shape::Operation::unite:
      return std::any_of(shape.parts.begin(), shape.parts.end(), part_contains);
    case Shape::Operation::intersect:
      return std::all_of(shape.parts.begin(), shape.parts.end(), part_contains);
    default:
      return part_contains(shape.parts.front()) &&
             std::none_of(shape.parts.begin() + 1, shape.parts.end(), part_contains);
  }
}

double distance_to_boundary(const Shape& shape, const Vec2& p) {
  double least = HUGE_VAL;
  if (shape.operation == Shape::Operation::outline) {
    least = distance_to_boundary(OutlineEdges(shape.outline), p);
  }
  for (const Shape& part : shape.parts) least = std::min(least, distance_to_boundary(part, p));
  return least;
}

TEST(Resolve, EnclosesWhatTheExpressionSays) {
  Random random(20240611);
  for (int round = 0; round < 150; ++round) {
    SCOPED_TRACE(round);
    const Shape shape = random_shape(random, 2);
    const Outline outline = resolve(shape);
    const OutlineEdges edges(outline);
    const double size = size_of(shape);
    // Next to the boundary, too: corners lie on the curves, not on chords, which keep 3e-5 of the size off them.
    std::vector<Vec2> points = points_beside(outline, 1e-7 * size);
    for (int i = 0; i < 200; ++i) points.push_back({random.uniform(-size, size), random.uniform(-size, size)});
    for (const Vec2& p : points) {
      if (distance_to_boundary(shape, p) < 5e-8 * size) continue;
      EXPECT_EQ(!outline.loops.empty() && edges.contains(p), contains(shape, p)) << p.x << ' ' << p.y;
    }
  }
}

TEST(Resolve, KeepsArcsAndCorners) {
  const Outline circle{{{{0, -3, 1}, {0, 3, 1}}}}, square{{{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}}};
  EXPECT_EQ(resolve(Shape::of(circle)), circle);
  EXPECT_EQ(resolve({Shape::Operation::unite, {}, {Shape::of(circle), Shape::of(circle)}}), circle);
  const Outline quarter = resolve({Shape::Operation::intersect, {}, {Shape::of(circle), Shape::of(square)}});
  ASSERT_EQ(quarter.loops.size(), 1u);
  ASSERT_EQ(quarter.loops[0].size(), 3u);
  for (const OutlineCorner& c : quarter.loops[0]) {
    EXPECT_TRUE(c.x == 0 || c.x == 3) << c.x;
    EXPECT_TRUE(c.bulge == 0 || std::fabs(c.bulge - (std::sqrt(2) - 1)) < 1e-15) << c.bulge;
  }
}

TEST(Resolve, LeavesNothingOfShapesThatCancel) {
  const Outline ring{{{{0, -3, 1}, {0, 3, 1}}, {{1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}}}};
  // The same circle from another start.
  const Outline turned{{{{-3, 0, 1}, {3, 0, 1}}, {{1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}}}};
  EXPECT_TRUE(resolve({Shape::Operation::subtract, {}, {Shape::of(ring), Shape::of(ring)}}).loops.empty());
  EXPECT_TRUE(resolve({Shape::Operation::subtract, {}, {Shape::of(ring), Shape::of(turned)}}).loops.empty());
  EXPECT_TRUE(resolve({}).loops.empty());
}

// A grid finer than doubles, or coarser, has no points.
TEST(Resolve, MakesNothingOfSizesThatNothingHas) {
  for (const double size : {1e-320, 1e-100, 1e100, 1e308}) {
    const Outline triangle{{{{0, 0, 0}, {size, 0, 0.3}, {0, size, 0}}}};
    EXPECT_TRUE(resolve(Shape::of(triangle)).loops.empty()) << size;
    EXPECT_TRUE(resolve_winding(triangle).loops.empty()) << size;
  }
  const Outline small{{{{0, 0, 0}, {1e-59, 0, 0}, {0, 1e-59, 0}}}};
  EXPECT_EQ(resolve(Shape::of(small)).loops.size(), 1u);
}

TEST(ResolveWinding, FillsWhereLoopsOverlap) {
  const Outline cross{
      {{{-3, -1, 0}, {3, -1, 0}, {3, 1, 0}, {-3, 1, 0}}, {{-1, -3, 0}, {1, -3, 0}, {1, 3, 0}, {-1, 3, 0}}}};
  EXPECT_TRUE(OutlineEdges(resolve_winding(cross)).contains({0, 0}));
  EXPECT_FALSE(OutlineEdges(resolve(Shape::of(cross))).contains({0, 0}));
}

}  // namespace
}  // namespace tenon
