#include <gtest/gtest.h>

#include <cmath>

#include "primitive/outline_checks.h"
#include "primitive/random_placement.h"
#include "primitive/revolution.h"

namespace tenon {
namespace {

// Off the axis, or up to it and along it.
Revolution random_revolution(Random& random, bool with_arcs) {
  Revolution solid;
  do {
    solid.outline = outlines::random_outline(random, with_arcs);
    const double aside = random.uniform(0, 4);
    for (auto& loop : solid.outline.loops) {
      for (OutlineCorner& corner : loop) corner.x = std::max(corner.x + aside, 0.0);
    }
    solid.prepare();
  } while (!solid.check().empty());
  return solid;
}

// Where a solid is said to be what a few walls bound, the way from the place that is known tells of every point.
TEST(RevolutionPieces, WallsTellTheSolidWithinTheirBox) {
  Random random(94);
  outlines::WallParts<RevolvedPart> parts;
  int around_axis = 0;
  for (int round = 0; round < 20000; ++round) {
    const Revolution solid = random_revolution(random, true);
    const OutlineCorner& corner = outlines::random_corner(solid.outline, random);
    const double angle = random.uniform(-3, 3), r = random.chance(0.1) ? 0 : corner.x;
    const Vec3 around = Vec3{r * std::cos(angle), r * std::sin(angle), corner.y} + 0.1 * random.in_cube();
    const auto box = parts.check(solid, around, 0, random, [](const Vec3& p) -> std::optional<Vec2> {
      return Vec2{std::hypot(p.x, p.y), p.z};
    });
    around_axis += box && box->bounds.contains(Vec3{0, 0, box->center.z});
  }
  parts.expect_many();
  EXPECT_GT(around_axis, 800);
}

// The edge between two corners at one place has no length, and no line lies in it.
TEST(RevolutionPieces, CornersThatAreGivenTwiceBoundNothing) {
  Revolution once, twice;
  once.outline = {{{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}}};
  twice.outline = {{{{1, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 1, 0}, {1, 1, 0}}}};
  once.prepare();
  twice.prepare();
  ASSERT_TRUE(twice.check().empty());
  for (const double z : {0.0, 0.5, 1.0}) {
    LocalRay ray;
    ray.origin = {-3, 0, z};
    ray.direction = {1, 0, 0};
    ray.origin_error = {1e-14, 1e-14, 1e-14};
    Spans expected, found;
    once.spans(ray, expected);
    twice.spans(ray, found);
    ASSERT_EQ(found.size(), expected.size()) << "z = " << z;
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].t, expected[i].t) << "z = " << z;
  }
}

// A crossing that is found from its neighbourhood is that of spans(), to the last bit.
TEST(RevolutionPieces, CrossingsFoundFromNearbyAreThoseOfSpans) {
  Random random(95);
  outlines::NearbyCrossings crossings;
  for (int round = 0; round < 15000; ++round) {
    const Revolution solid = random_revolution(random, random.chance(0.5));
    for (int i = 0; i < 10; ++i) {
      LocalRay ray;
      const Vec3 aim = 4 * random.in_cube() * Vec3{1, 1, 0.5};
      ray.direction = random.chance(0.1) ? Vec3{0, 0, 1} : random.direction();
      // Through the axis, now and then.
      ray.origin = (random.chance(0.1) ? Vec3{0, 0, aim.z} : aim) + 0.1 * ray.direction;
      const double error = random.magnitude(-15, -10);
      ray.origin_error = {error, error, error};
      ray.direction_error = 0.1 * ray.origin_error;
      crossings.check(solid, ray, random);
      crossings.check_from_start(solid, ray, random);
    }
  }
  EXPECT_GT(crossings.found, crossings.asked / 2);
}

}  // namespace
}  // namespace tenon
