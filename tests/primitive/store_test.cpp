#include "tenon/primitive/primitive_store.h"

#include <gtest/gtest.h>

#include <limits>

#include "primitive/dispatch.h"

namespace tenon {
namespace {

std::string problem(std::string_view kind, std::vector<FieldValue> values) {
  PrimitiveStore store;
  const auto added = store.add(*PrimitiveStore::find_kind(kind), values);
  EXPECT_EQ(store.size(), added ? 1u : 0u);
  return added ? "" : added.error().message;
}

TEST(PrimitiveStore, EveryKindHasItsFieldsAndAValidFallback) {
  for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
    EXPECT_EQ(PrimitiveStore::find_kind(kind.name), &kind);
    EXPECT_FALSE(kind.doc.empty());
    PrimitiveStore store;
    std::vector<FieldValue> values;
    for (const FieldInfo& field : kind.fields) {
      EXPECT_FALSE(field.doc.empty()) << kind.name << '.' << field.name;
      values.push_back(field.fallback);
    }
    const auto id = store.add(kind, values);
    ASSERT_TRUE(id) << id.error().message;
    EXPECT_EQ(&store.kind(*id), &kind);
    EXPECT_EQ(store.values(*id), values);
    EXPECT_GT(cost(store, *id), 0);
    EXPECT_EQ(local_bounds(store, *id).is_bounded(), kind.bounded);
  }
  EXPECT_EQ(PrimitiveStore::find_kind("teapot"), nullptr);
}

TEST(PrimitiveStore, KeepsPrimitivesOfManyKindsApart) {
  PrimitiveStore store;
  const auto sphere = store.add(*PrimitiveStore::find_kind("sphere"), std::vector<FieldValue>{2.0});
  const auto cone = store.add(*PrimitiveStore::find_kind("cone"), std::vector<FieldValue>{1.0, 2.0, 3.0, false});
  const auto other = store.add(*PrimitiveStore::find_kind("sphere"), std::vector<FieldValue>{5.0});
  PrimitiveStore moved = std::move(store);
  EXPECT_EQ(std::get<double>(moved.values(*sphere)[0]), 2.0);
  EXPECT_EQ(std::get<double>(moved.values(*cone)[2]), 3.0);
  EXPECT_EQ(std::get<double>(moved.values(*other)[0]), 5.0);
}

TEST(PrimitiveStore, SizesThatMakeNoSolidAreRefusedWithTheReason) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(problem("sphere", {0.0}), "sphere with r = 0 has no volume");
  EXPECT_EQ(problem("sphere", {-1.5}), "sphere with r = -1.5 has no volume");
  EXPECT_EQ(problem("sphere", {inf}), "sphere with r = inf is not finite");
  EXPECT_EQ(problem("sphere", {nan}), "sphere with r = nan is not finite");
  EXPECT_EQ(problem("sphere", {1e-100}), "sphere with r = 1e-100 is too small to compute with; sizes start at 1e-60");
  EXPECT_EQ(problem("sphere", {1e100}), "sphere with r = 1e+100 is too large to compute with; sizes end at 1e60");
  EXPECT_EQ(problem("cube", {Vec3{1, 0, 1}, false}), "cube with size.y = 0 has no volume");
  EXPECT_EQ(problem("cube", {Vec3{1, 1, -2}, true}), "cube with size.z = -2 has no volume");
  EXPECT_EQ(problem("cylinder", {0.0, 1.0, false}), "cylinder with h = 0 has no volume");
  EXPECT_EQ(problem("cylinder", {1.0, nan, false}), "cylinder with r = nan is not finite");
  EXPECT_EQ(problem("cone", {1.0, 0.0, 0.0, false}), "cone with r1 = 0 and r2 = 0 has no volume");
  EXPECT_EQ(problem("cone", {1.0, 0.0, 1.0, false}), "");
  EXPECT_EQ(problem("cone", {1.0, 1.0, -1.0, false}), "cone with r2 = -1 has no volume");
  EXPECT_EQ(problem("torus", {1.0, 0.0}), "torus with r = 0 has no volume");
  EXPECT_EQ(problem("torus", {1.0, 1.0}), "");
  EXPECT_EQ(problem("torus", {1.0, 2.0}),
            "torus with R = 1 and r = 2 runs into itself; keep r at most R, or use a sphere");
  EXPECT_EQ(problem("hyperboloid", {1.0, 1.0, 2.0}),
            "hyperboloid with waist = 2 and r = 1 bulges; its waist must not exceed its radius");
  EXPECT_EQ(problem("hyperboloid", {1.0, 1.0, 1.0}), "");
  EXPECT_EQ(problem("hyperboloid", {1.0, 1.0, 0.0}), "hyperboloid with waist = 0 has no volume");
  EXPECT_EQ(problem("paraboloid", {0.0, 1.0}), "paraboloid with h = 0 has no volume");
  EXPECT_EQ(problem("halfspace", {Vec3{}, 1.0}), "halfspace with |normal| = 0 has no volume");
  EXPECT_EQ(problem("halfspace", {Vec3{0, 0, 1}, nan}), "halfspace with |d| = nan is not finite");
  EXPECT_NE(problem("sphere", {true}), "");
  EXPECT_NE(problem("sphere", {1.0, 1.0}), "");
}

TEST(PrimitiveStore, OutlinesThatEncloseNothingAreRefused) {
  const auto prism = [](std::vector<std::vector<OutlineCorner>> loops) {
    return problem("prism", {Outline{std::move(loops)}, 1.0, false, 1.0});
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(prism({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}), "");
  EXPECT_EQ(prism({{{0, 0, 1}, {1, 0, 1}}}), "");
  EXPECT_EQ(prism({}), "prism with an outline of no corners has no volume");
  EXPECT_EQ(prism({{{1, 2, 0}}}), "an outline of prism needs at least two corners in each loop");
  EXPECT_EQ(prism({{{1, 2, 0}, {1, 2, 0}, {1, 2, 0}}}), "prism with an outline of one point has no volume");
  EXPECT_EQ(prism({{{0, 0, 0}, {1, nan, 0}, {0, 1, 0}}}), "corner 1 of the outline of prism is not finite");
  EXPECT_EQ(prism({{{0, 0, 2000}, {1, 0, 0}}}),
            "corner 0 of the outline of prism has a bulge beyond 1000, an arc that is all but a full circle");
}

TEST(PrimitiveStore, OutlinesBeyondTheAxisAreRefused) {
  const auto revolution = [](std::vector<OutlineCorner> loop) {
    return problem("revolution", {Outline{{std::move(loop)}}});
  };
  EXPECT_EQ(revolution({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "");
  EXPECT_EQ(revolution({{0, -1, 1}, {0, 1, 0}}), "");
  EXPECT_EQ(revolution({{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}),
            "revolution has an outline that reaches over the axis; keep the distances at least 0");
  EXPECT_EQ(revolution({{0, 0, 0}, {0, 1, 0}, {0, 2, 0}}),
            "revolution has an outline without distance from the axis, and no volume");
}

TEST(PrimitiveStore, PlanesThatEncloseNothingAreRefused) {
  const auto polyhedron = [](std::vector<Plane> planes) { return problem("convex_polyhedron", {std::move(planes)}); };
  std::vector<Plane> cube{{{-1, 0, 0}, 0}, {{1, 0, 0}, 1},  {{0, -1, 0}, 0},
                          {{0, 1, 0}, 1},  {{0, 0, -1}, 0}, {{0, 0, 1}, 1}};
  EXPECT_EQ(polyhedron(cube), "");
  EXPECT_EQ(polyhedron({}), "convex_polyhedron is empty or unbounded; its planes must enclose a volume");
  auto open = cube;
  open.pop_back();
  EXPECT_EQ(polyhedron(open), "convex_polyhedron is unbounded; add the planes that close it");
  auto flat = cube;
  flat[1].d = 0;
  EXPECT_EQ(polyhedron(flat), "convex_polyhedron has no volume");
  auto inside_out = cube;
  inside_out[1].d = -1;
  EXPECT_NE(polyhedron(inside_out), "");
  auto bad = cube;
  bad[2].normal = {};
  EXPECT_EQ(polyhedron(bad), "plane 3 of convex_polyhedron has a normal of length 0");
  // A plane twice, and one that only touches a corner, change nothing.
  auto redundant = cube;
  redundant.push_back(cube[0]);
  redundant.push_back({{1, 1, 1}, 3});
  EXPECT_EQ(polyhedron(redundant), "");
}

}  // namespace
}  // namespace tenon
