#include <gtest/gtest.h>

#include "primitive/check_crossings.h"
#include "primitive/dispatch.h"
#include "primitive/outline_checks.h"
#include "primitive/prism.h"

namespace tenon {
namespace {

using exact::Quad;

// A ray that starts on the wall over an edge, at a place known to within a few roundings.
LocalRay ray_from(const Vec3& place, std::uint32_t face, Random& random) {
  LocalRay ray;
  ray.origin = place;
  ray.origin_error = 4 * unit_roundoff * (abs(place) + Vec3{1, 1, 1});
  ray.direction = random.magnitude(-2, 2) * random.direction();
  ray.on_face = static_cast<int>(face);
  return ray;
}

// Whether what a ray crosses says of the places just before its start and just behind it what the definition does.
// Places are asked where those around agree, so that the ray's own error does not matter.
void expect_true_sides(PrimitiveStore& store, PrimitiveId id, const oracle::Solid<Quad>& definition,
                       const LocalRay& ray, int& asked) {
  Spans out;
  spans(store, id, ray, out);
  ASSERT_FALSE(check_order(out)) << *check_order(out);
  const double unit = 1 / length(ray.direction);
  for (const double t : {-1e-6 * unit, 1e-6 * unit}) {
    const auto contains = [&](double at, const Vec3& beside) {
      return definition.contains(exact::Vec<Quad>(ray.origin + at * ray.direction + beside));
    };
    const bool is_inside = contains(t, {});
    bool is_clear = true;
    for (const double share : {0.5, 2.0}) is_clear = is_clear && contains(share * t, {}) == is_inside;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 beside;
      beside[axis] = 1e-8;
      is_clear = is_clear && contains(t, beside) == is_inside && contains(t, -beside) == is_inside;
    }
    if (!is_clear) continue;
    ++asked;
    bool inside = false;
    for (const Crossing& c : out) inside ^= c.t <= t;
    EXPECT_EQ(inside, is_inside) << "at " << t << describe(out) << describe(ray.origin, ray.direction);
  }
}

// Where a wall meets a cap, the line's part between the caps begins within the error of the start.
TEST(OutlineStarts, WhereAWallMeetsACapTellBothSides) {
  Random random(71);
  int asked = 0;
  for (int round = 0; round < 400; ++round) {
    SCOPED_TRACE(round);
    const Outline outline = outlines::random_outline(random, round % 2 == 1);
    const double scale = round % 3 == 0 ? 1 : random.uniform(0.2, 2);
    const bool is_twisted = round % 4 == 3;
    const std::vector<FieldValue> values =
        is_twisted ? std::vector<FieldValue>{outline, 1.0, false, random.uniform(-90, 90), scale, scale}
                   : std::vector<FieldValue>{outline, 1.0, false, scale};
    const char* kind = is_twisted ? "twisted_prism" : "prism";
    PrimitiveStore store;
    const auto id = store.add(*PrimitiveStore::find_kind(kind), values);
    ASSERT_TRUE(id);
    const oracle::Solid<Quad> definition(kind, values);
    const OutlineEdges edges(outline);
    for (std::uint32_t i = 0; i < edges.edges().size(); ++i) {
      const OutlineEdge& edge = edges.edges()[i];
      // An arc is known at its ends alone.
      const double share = edge.is_arc() || random.chance(0.3) ? 0.0 : random.uniform(0, 1);
      const Vec2 p = edge.from + share * edge.chord();
      for (int k = 0; k < 20; ++k) {
        expect_true_sides(store, *id, definition, ray_from({p.x, p.y, 0}, Prism::walls + 2 * i, random), asked);
      }
    }
  }
  EXPECT_GT(asked, 50'000);
}

TEST(OutlineStarts, AtTheRimsOfARevolutionTellBothSides) {
  Random random(73);
  int asked = 0;
  for (int round = 0; round < 400; ++round) {
    SCOPED_TRACE(round);
    Outline outline = outlines::random_outline(random, round % 2 == 1);
    for (auto& loop : outline.loops) {
      for (OutlineCorner& corner : loop) corner.x += 3;
    }
    PrimitiveStore store;
    const std::vector<FieldValue> values{outline};
    const auto id = store.add(*PrimitiveStore::find_kind("revolution"), values);
    ASSERT_TRUE(id);
    const oracle::Solid<Quad> definition("revolution", values);
    const OutlineEdges edges(outline);
    for (std::uint32_t i = 0; i < edges.edges().size(); ++i) {
      const Vec2 p = edges.edges()[i].from;
      for (int k = 0; k < 10; ++k) {
        const double angle = random.uniform(0, 2 * std::numbers::pi);
        const Vec3 place{p.x * std::cos(angle), p.x * std::sin(angle), p.y};
        expect_true_sides(store, *id, definition, ray_from(place, 2 * i, random), asked);
      }
    }
  }
  EXPECT_GT(asked, 30'000);
}

}  // namespace
}  // namespace tenon
