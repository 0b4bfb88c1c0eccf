#include <gtest/gtest.h>

#include "primitive/dispatch.h"
#include "support/random.h"

// Planar polygons in space: which points are inside by either test, and the normals between those of the corners.
namespace tenon {
namespace {

Choice method(std::string_view name) {
  Choice choice = std::get<Choice>(PrimitiveStore::find_kind("polygon3d")->fields[2].fallback);
  while (choice.name() != name) ++choice.index;
  return choice;
}

struct Polygon {
  PrimitiveStore store;
  PrimitiveId id;

  Polygon(const PointLists& points, std::string_view by, const PointLists& normals = {}) {
    const auto added =
        store.add(*PrimitiveStore::find_kind("polygon3d"), std::vector<FieldValue>{points, normals, method(by)});
    EXPECT_TRUE(added) << (added ? "" : added.error().message);
    id = *added;
  }
  Spans cross(const LocalRay& ray) const {
    Spans out;
    spans(store, id, ray, out);
    return out;
  }
  bool is_hit(const Vec3& origin, const Vec3& direction) const {
    return !cross({origin, direction, {}, {}, -1}).empty();
  }
};

std::string problem(const PointLists& points, const PointLists& normals = {}) {
  PrimitiveStore store;
  const auto added =
      store.add(*PrimitiveStore::find_kind("polygon3d"), std::vector<FieldValue>{points, normals, method("snyder")});
  return added ? "" : added.error().message;
}

// A frame for a plane: any three directions at right angles.
struct Frame {
  Vec3 x, y, z, origin;

  explicit Frame(Random& random) : x(random.direction()), origin(10 * random.in_cube()) {
    y = normalize(tenon::cross(x, random.direction()));
    z = tenon::cross(x, y);
  }
  Vec3 at(double u, double v, double w = 0) const { return origin + u * x + v * y + w * z; }
};

// By the definition: how often the way to the right meets the loops.
bool is_inside(const std::vector<std::vector<Vec3>>& loops, double u, double v) {
  bool inside = false;
  for (const auto& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if ((a.y <= v) != (b.y <= v)) inside ^= u < a.x + (v - a.y) * (b.x - a.x) / (b.y - a.y);
    }
  }
  return inside;
}

TEST(Polygon3d, ConcaveOnesWithHolesAreAsDefinedByEitherTest) {
  Random random(3);
  for (int n = 0; n < 200; ++n) {
    const Frame frame(random);
    PointLists flat;
    for (int l = 1 + random.below(3); l > 0; --l) {
      auto& loop = flat.emplace_back();
      const int corners = 3 + random.below(7);
      // A star, of either sense, or a tangle.
      const bool tangled = random.chance(0.3);
      const double sense = random.sign(), size = random.uniform(0.2, 1);
      for (int i = 0; i < corners; ++i) {
        const double angle = sense * (tangled ? random.uniform(0, 6.28) : 6.28 * i / corners);
        const double r = size * random.uniform(0.2, 1);
        loop.push_back({r * std::cos(angle), r * std::sin(angle), 0});
      }
    }
    PointLists points = flat;
    for (auto& loop : points) {
      for (Vec3& p : loop) p = frame.at(p.x, p.y);
    }
    if (!problem(points).empty()) continue;
    const Polygon snyder(points, "snyder"), marchal(points, "marchal");
    for (int i = 0; i < 200; ++i) {
      const double u = random.uniform(-1.1, 1.1), v = random.uniform(-1.1, 1.1);
      const Vec3 from = frame.at(random.uniform(-3, 3), random.uniform(-3, 3), random.sign() * random.uniform(0.1, 3));
      const Vec3 direction = random.magnitude(-1, 1) * (frame.at(u, v) - from);
      EXPECT_EQ(snyder.is_hit(from, direction), is_inside(flat, u, v)) << n << ", " << u << ", " << v;
      EXPECT_EQ(marchal.is_hit(from, direction), is_inside(flat, u, v)) << n << ", " << u << ", " << v;
    }
  }
}

TEST(Polygon3d, CrossingsLieInThePlaneWithinTheirBounds) {
  Random random(4);
  const PointLists square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  const Polygon polygon(square, "snyder");
  for (int i = 0; i < 2'000; ++i) {
    LocalRay ray;
    ray.direction = random.direction();
    ray.origin = Vec3{random.uniform(0, 1), random.uniform(0, 1), 0} - random.uniform(-5, 5) * ray.direction;
    ray.origin_error = random.magnitude(-16, -6) * abs(random.in_cube());
    const Spans out = polygon.cross(ray);
    if (out.empty()) continue;
    ASSERT_EQ(out.size(), 1u);
    EXPECT_TRUE(out[0].surface);
    for (const double s : {-1.0, 0.0, 1.0}) {
      const double exact = -(ray.origin.z + s * ray.origin_error.z) / ray.direction.z;
      EXPECT_NEAR(out[0].t, exact, out[0].bound * (1 + 1e-12));
    }
  }
}

// Rays through an edge that two polygons share meet one or the other, whatever rounding does.
TEST(Polygon3d, PolygonsThatShareAnEdgeLeaveNoGap) {
  Random random(5);
  for (int n = 0; n < 50; ++n) {
    const Frame frame(random);
    const Vec3 a = frame.at(0, 0), b = frame.at(1, 0);
    const std::string_view by = n % 2 == 0 ? "snyder" : "marchal";
    const Polygon left({{a, b, frame.at(1, 1), frame.at(0, 1)}}, by);
    const Polygon right({{b, a, frame.at(0.5, -1, 0.5)}}, by);
    for (int i = 0; i < 200; ++i) {
      LocalRay ray;
      ray.origin = frame.at(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(1, 3));
      ray.direction = a + random.uniform(0, 1) * (b - a) - ray.origin;
      ray.origin_error = 1e-14 * Vec3{1, 1, 1};
      EXPECT_TRUE(!left.cross(ray).empty() || !right.cross(ray).empty());
    }
  }
}

TEST(Polygon3d, NormalsAreThoseOfTheCornersAndBetweenThem) {
  const PointLists square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  const PointLists normals{{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
  for (const std::string_view by : {"snyder", "marchal"}) {
    const Polygon polygon(square, by, normals);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(dot(normalize(normal(polygon.store, polygon.id, square[0][i], 0)), normalize(normals[0][i])), 1,
                  1e-12);
      const Vec3 middle = 0.5 * (square[0][i] + square[0][(i + 1) % 4]);
      const Vec3 between = normals[0][i] + normals[0][(i + 1) % 4];
      EXPECT_NEAR(dot(normalize(normal(polygon.store, polygon.id, middle, 0)), normalize(between)), 1, 1e-12);
    }
    // Along the diagonal from the first corner both are linear.
    const Vec3 n = normalize(normal(polygon.store, polygon.id, {0.25, 0.25, 0}, 0));
    EXPECT_NEAR(dot(n, normalize(Vec3{-0.5, -0.5, 1})), 1, 1e-12) << by;
  }
  // Without normals, the plane's.
  EXPECT_EQ(normal(Polygon(square, "snyder").store, Polygon(square, "snyder").id, {0.2, 0.7, 0}, 0), (Vec3{0, 0, 1}));
}

TEST(Polygon3d, InAConcaveOneNormalsStayUpright) {
  // An L. By Snyder's fans, normals of two points a little apart are a little apart.
  const PointLists corner{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}};
  PointLists normals = corner;
  for (Vec3& n : normals[0]) n = normalize(Vec3{n.x - 1, n.y - 1, 2});
  for (const std::string_view by : {"snyder", "marchal"}) {
    const Polygon polygon(corner, by, normals);
    Random random(6);
    for (int i = 0; i < 2'000; ++i) {
      const bool upper = random.chance(0.5);
      const Vec3 p{random.uniform(0.01, upper ? 0.98 : 1.98), random.uniform(0.01, upper ? 1.98 : 0.98), 0};
      const Vec3 n = normalize(normal(polygon.store, polygon.id, p, 0));
      const Vec3 near = normalize(normal(polygon.store, polygon.id, p + Vec3{1e-7, 1e-7, 0}, 0));
      EXPECT_GT(n.z, 0.5) << by;
      if (by == "snyder") {
        EXPECT_LT(length(n - near), 1e-5) << p.x << ' ' << p.y;
      }
    }
  }
}

TEST(Polygon3d, EdgeOnAndFromItself) {
  const PointLists square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}};
  const Polygon polygon(square, "snyder");
  EXPECT_TRUE(polygon.cross({{-1, 0.5, 0}, {1, 0, 0}, {}, {}, -1}).empty());
  const Spans start = polygon.cross({{0.5, 0.5, 1e-17}, {0, 0.1, 1}, {}, {}, 0});
  ASSERT_EQ(start.size(), 1u);
  EXPECT_EQ(start[0].t, 0);
  EXPECT_EQ(start[0].bound, 0);
}

TEST(Polygon3d, WhatIsNonePlanarIsRefusedWithTheDeviation) {
  EXPECT_EQ(
      problem({{{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5}, {0, 1, 0}}}).find("polygon3d is not planar: its corners deviate"),
      0u);
  EXPECT_EQ(problem({{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}}), "polygon3d has no area");
  EXPECT_EQ(problem({{{0, 0, 0}, {1, 0, 0}}}), "a loop of polygon3d has fewer than three corners");
  EXPECT_EQ(problem({}), "polygon3d without corners shows nothing");
  EXPECT_EQ(problem({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0, 0, 1}}}),
            "polygon3d needs as many normals as corners, or none");
  EXPECT_EQ(problem({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0, 0, 1}, {0, 0, 0}, {0, 0, 1}}}),
            "a normal of polygon3d has no direction");
}

}  // namespace
}  // namespace tenon
