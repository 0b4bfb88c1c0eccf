#include <gtest/gtest.h>

#include <cmath>

#include "primitive/outline_checks.h"
#include "primitive/random_placement.h"
#include "primitive/twisted_prism.h"

namespace tenon {
namespace {

TwistedPrism random_twisted_prism(Random& random, bool with_arcs) {
  TwistedPrism solid;
  do {
    solid.outline = outlines::random_outline(random, with_arcs);
    solid.h = random.uniform(0.5, 4);
    solid.center = random.chance(0.5);
    solid.twist = random.chance(0.1) ? 0 : random.sign() * random.magnitude(0, 3);
    if (random.chance(0.5)) solid.scale_x = solid.scale_y = random.uniform(0.3, 2);
    if (random.chance(0.3)) solid.scale_y = random.uniform(0.3, 2);
    solid.prepare();
  } while (!solid.check().empty());
  return solid;
}

// Where a solid is said to be what a few walls bound, the way from the place that is known tells of every point.
TEST(TwistedPieces, WallsTellTheSolidWithinTheirBox) {
  Random random(97);
  outlines::WallParts<TwistedPart> parts;
  int scaled = 0, still = 0;
  for (int round = 0; round < 20000; ++round) {
    const TwistedPrism solid = random_twisted_prism(random, true);
    const OutlineCorner& corner = outlines::random_corner(solid.outline, random);
    const double share = random.uniform(0, 1), angle = -solid.twist * share * std::numbers::pi / 180;
    const double x = std::cos(angle) * corner.x - std::sin(angle) * corner.y;
    const double y = std::sin(angle) * corner.x + std::cos(angle) * corner.y;
    const Vec3 on_edge{x * (1 + (solid.scale_x - 1) * share), y * (1 + (solid.scale_y - 1) * share),
                       solid.low() + share * solid.h};
    const TwistedPart& part = parts.part;
    const auto box =
        parts.check(solid, on_edge + 0.05 * random.in_cube(), -0.2, random, [&](const Vec3& p) -> std::optional<Vec2> {
          const double z = p.z - part.middle, turn = part.turn * z, c = std::cos(turn), s = std::sin(turn);
          const double a = p.x / (part.scale.x + part.scale_slope.x * z);
          const double b = p.y / (part.scale.y + part.scale_slope.y * z);
          EXPECT_LE(length(Vec2{a, b}), part.reach * (1 + 1e-9));
          if (p.z < solid.low() || p.z > solid.high()) return std::nullopt;
          return Vec2{c * a - s * b, s * a + c * b};
        });
    scaled += box && (solid.scale_x != 1 || solid.scale_y != 1);
    still += box && solid.twist == 0;
  }
  parts.expect_many();
  EXPECT_GT(scaled, 5000);
  EXPECT_GT(still, 500);
}

// A crossing that is found from its neighbourhood is that of spans(), to the last bit.
TEST(TwistedPieces, CrossingsFoundFromNearbyAreThoseOfSpans) {
  Random random(98);
  outlines::NearbyCrossings crossings;
  for (int round = 0; round < 1500; ++round) {
    const TwistedPrism solid = random_twisted_prism(random, random.chance(0.5));
    for (int i = 0; i < 10; ++i) {
      LocalRay ray;
      ray.direction = random.chance(0.1) ? Vec3{0, 0, 1} : random.direction();
      ray.origin = 4 * random.in_cube() * Vec3{1, 1, 0.5} + 0.1 * ray.direction;
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
