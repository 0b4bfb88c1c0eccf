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
    solid.twist = random.sign() * random.magnitude(0, 3);
    if (random.chance(0.5)) solid.scale_x = solid.scale_y = random.uniform(0.3, 2);
    if (random.chance(0.3)) solid.scale_y = random.uniform(0.3, 2);
    solid.prepare();
  } while (!solid.check().empty());
  return solid;
}

// Where a solid is said to be what a few walls bound, the way from the place that is known tells of every point.
TEST(TwistedPieces, WallsTellTheSolidWithinTheirBox) {
  Random random(97);
  int parts = 0, with_arcs = 0, crowded = 0, scaled = 0, points = 0, inside = 0;
  for (int round = 0; round < 20000; ++round) {
    const TwistedPrism solid = random_twisted_prism(random, true);
    const Affine3 map =
        random.chance(0.5) ? Affine3::rotate({0, 0, 0}) : Affine3::rotate(90 * random.in_cube() + Vec3{10, 0, 0});
    const auto placement = Placement::create(BoundedAffine3::elementary(map), {0, 0, 0});
    ASSERT_TRUE(placement);
    const auto& loop = solid.outline.loops[random.below(static_cast<int>(solid.outline.loops.size()))];
    const OutlineCorner& corner = loop[static_cast<std::size_t>(random.below(static_cast<int>(loop.size())))];
    const double share = random.uniform(0, 1), angle = -solid.twist * share * std::numbers::pi / 180;
    const double x = std::cos(angle) * corner.x - std::sin(angle) * corner.y;
    const double y = std::sin(angle) * corner.x + std::cos(angle) * corner.y;
    const Vec3 on_edge{x * (1 + (solid.scale_x - 1) * share), y * (1 + (solid.scale_y - 1) * share),
                       solid.low() + share * solid.h};
    const Vec3 middle = map.point(on_edge) + 0.05 * random.in_cube();
    const Vec3 half = random.magnitude(-3, -0.5) * Vec3{1, random.uniform(0.3, 1), 1};
    const LocalBox box = placement->to_local(Box3{middle - half, middle + half});
    constexpr std::size_t most = 5;
    TwistedPart part;
    if (!solid.walls_within(box, most, part)) continue;
    ASSERT_LE(part.walls.size(), most);
    ++parts;
    crowded += part.walls.size() > 2;
    scaled += solid.scale_x != 1 || solid.scale_y != 1;
    with_arcs += std::any_of(part.walls.begin(), part.walls.end(), [](const OutlineEdge& w) { return w.is_arc(); });
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = placement->point_to_local(middle + half * random.in_cube());
      if (p.z < solid.low() || p.z > solid.high()) continue;
      const double z = p.z - part.middle, turn = part.turn * z, c = std::cos(turn), s = std::sin(turn);
      const Vec2 flat{p.x / (part.scale.x + part.scale_slope.x * z), p.y / (part.scale.y + part.scale_slope.y * z)};
      const Vec2 place{c * flat.x - s * flat.y, s * flat.x + c * flat.y};
      ASSERT_LE(length(place), part.reach * (1 + 1e-9));
      // Chords are that far from their arcs.
      const auto is_near = [&](const OutlineEdge& w) {
        return std::fabs(w.distance(place - w.from)) < 1e-3 || std::fabs(w.distance(part.place - w.from)) < 1e-3;
      };
      if (std::any_of(part.walls.begin(), part.walls.end(), is_near)) continue;
      int passed = part.is_inside ? 1 : 0;
      for (const OutlineEdge& wall : part.walls) passed += outlines::crossings(wall, part.place, place);
      // By a box of no size.
      const Region region = solid.classify(placement->to_local(Box3{map.point(p), map.point(p)}));
      if (region == Region::straddles) continue;
      ASSERT_EQ(passed % 2 != 0, region == Region::inside) << "round " << round << " point " << i;
      ++points;
      inside += region == Region::inside;
    }
  }
  EXPECT_GT(parts, 10000);
  EXPECT_GT(with_arcs, 5000);
  EXPECT_GT(crowded, 500);
  EXPECT_GT(scaled, 5000);
  EXPECT_GT(inside, points / 5);
  EXPECT_LT(inside, 4 * points / 5);
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
    }
  }
  EXPECT_GT(crossings.found, crossings.asked / 2);
}

}  // namespace
}  // namespace tenon
