#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "primitive/dispatch.h"
#include "support/meshes.h"
#include "support/random.h"

namespace tenon {
namespace {

// What a solid of a kind is when nothing is said of it.
std::vector<FieldValue> plain(std::string_view kind) {
  std::vector<FieldValue> values;
  for (const FieldInfo& field : PrimitiveStore::find_kind(kind)->fields) values.push_back(field.fallback);
  return values;
}

// An algebraic torus, by the methods with these numbers.
std::vector<FieldValue> quartic(std::uint8_t isolation, std::uint8_t refinement) {
  std::vector<FieldValue> values = plain("algebraic");
  values[0] = PolynomialTerms{{4, 0, 0, 1}, {0, 4, 0, 1},    {0, 0, 4, 1},    {2, 2, 0, 2},    {2, 0, 2, 2},
                              {0, 2, 2, 2}, {2, 0, 0, -1.5}, {0, 2, 0, -1.5}, {0, 0, 2, 0.75}, {0, 0, 0, 0.25}};
  values[1] = Box3{{-2, -2, -1}, {2, 1.5, 1}};
  std::get<Choice>(values[2]).index = isolation;
  std::get<Choice>(values[3]).index = refinement;
  return values;
}

// Crossings are made of additions, multiplications, divisions and square roots alone, each rounded as IEEE 754 says, so
// that every compiler and machine finds the same bits. Here over placed primitives of every kind; a change of any
// formula changes the number, and then it is copied from the failure.
TEST(SameBits, OnEveryCompilerAndMachine) {
  const std::pair<std::string_view, std::vector<FieldValue>> solids[] = {
      {"sphere", {1.25}},
      {"cube", {Vec3{1, 2, 1.5}, true}},
      {"cylinder", {2.0, 0.75, false}},
      {"cone", {1.5, 1.0, 0.25, true}},
      {"torus", {1.0, 0.375}},
      {"hyperboloid", {2.0, 1.0, 0.625}},
      {"paraboloid", {1.75, 1.0}},
      {"halfspace", {Vec3{1, 2, 3}, 0.5}},
      {"convex_polyhedron",
       {std::vector<Plane>{
           {{1, 1, 1}, 1}, {{-1, 1, 0.5}, 1}, {{0.25, -1, 1}, 0.75}, {{0, 0.125, -1}, 1}, {{1, 0, 0}, 0.875}}}},
      {"prism",
       {Outline{{{{-1, -1, 0}, {1, -1, 0.5}, {1, 1, -0.25}, {-0.5, 1, 0}}, {{0.25, 0, 1}, {-0.25, 0, 1}}}}, 1.5, true,
        0.75}},
      {"revolution", {Outline{{{{0.25, -0.5, 0}, {1, -0.5, 0.5}, {0.75, 0.5, -0.25}, {0, 0.5, 0}}}}}},
      {"mesh", {meshes::share(meshes::star(2, [](const Vec3& v) { return 1 + 0.25 * v.x; })), false}},
      {"quadric", {QuadricCoefficients{1, 2, -1, 0.5, 0, 0.25, 0, 0.125, 0, -0.5}, Box3{{-1, -1.25, -1}, {1, 1, 1.5}}}},
      {"truncated_cone", {1.5, 1.0, 0.5, 0.25, 0.75}},
      {"algebraic", quartic(0, 0)},
      {"algebraic", quartic(0, 1)},
      {"algebraic", quartic(1, 2)},
      {"twisted_prism",
       {Outline{{{{-1, -1, 0}, {1, -1, 0.5}, {1, 1, -0.25}, {-0.5, 1, 0}}, {{0.25, 0, 1}, {-0.25, 0, 1}}}}, 1.5, true,
        200.0, 0.75, 1.25}},
      {"bicubic", plain("bicubic")},
      {"polygon3d", plain("polygon3d")}};
  for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
    const auto is_of_it = [&](const auto& solid) { return solid.first == kind.name; };
    EXPECT_TRUE(kind.name.empty() || std::any_of(std::begin(solids), std::end(solids), is_of_it)) << kind.name;
  }
  const Affine3 map{{{{0.8, -0.6, 0.1, 1.5}, {0.6, 0.7, -0.2, -2.25}, {0.05, 0.3, 1.2, 0.875}}}};
  std::uint64_t hash = 1469598103934665603u;
  const auto mix = [&hash](std::uint64_t bits) { hash = (hash ^ bits) * 1099511628211u; };
  Random random(3);
  for (const auto& [kind, values] : solids) {
    PrimitiveStore store;
    const PrimitiveId id = *store.add(*PrimitiveStore::find_kind(kind), values);
    const auto placement = Placement::create(BoundedAffine3::elementary(map), {});
    for (int i = 0; i < 2000; ++i) {
      const Vec3 through = map.point(1.5 * random.in_cube());
      // One random number a statement: operands may be evaluated in either order.
      Ray ray{{}, random.direction()};
      ray.direction *= random.uniform(0.25, 4);
      ray.origin = through - random.uniform(0, 8) * ray.direction;
      Spans out;
      spans(store, id, *placement, ray, i % 2 == 0 ? 0 : 0x1p-40, -1, out);
      mix(out.size());
      for (const Crossing& c : out) {
        mix(std::bit_cast<std::uint64_t>(c.t));
        mix(std::bit_cast<std::uint64_t>(c.bound));
        mix(c.face);
      }
    }
  }
  EXPECT_EQ(hash, 1688268085537265057u);
}

}  // namespace
}  // namespace tenon
