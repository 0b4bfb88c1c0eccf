#include <gtest/gtest.h>

#include <cmath>

#include "primitive/outline_checks.h"
#include "primitive/prism.h"
#include "primitive/random_placement.h"

namespace tenon {
namespace {

Prism random_prism(Random& random, bool with_arcs) {
  Prism prism;
  do {
    prism.outline = outlines::random_outline(random, with_arcs);
  } while (!prism.check().empty());
  prism.h = random.uniform(0.5, 2);
  prism.center = random.chance(0.5);
  prism.prepare();
  return prism;
}

// By the even-odd rule, along x. @return how far the nearest edge is, negative within
double distance_within(const Outline& outline, double x, double y) {
  bool inside = false;
  double nearest = HUGE_VAL;
  for (const auto& loop : outline.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if ((a.y > y) != (b.y > y) && x < (b.x - a.x) * (y - a.y) / (b.y - a.y) + a.x) inside = !inside;
      const double wx = b.x - a.x, wy = b.y - a.y, square = wx * wx + wy * wy;
      const double s = square > 0 ? std::clamp(((x - a.x) * wx + (y - a.y) * wy) / square, 0.0, 1.0) : 0;
      nearest = std::min(nearest, std::hypot(x - a.x - s * wx, y - a.y - s * wy));
    }
  }
  return inside ? -nearest : nearest;
}

// Where a prism is said to be what lies below some planes, it is.
TEST(PrismPieces, PlanesHoldThePrismWithinTheirBox) {
  Random random(91);
  int pieces = 0, corners = 0, notches = 0, points = 0, inside = 0;
  for (int round = 0; round < 20000; ++round) {
    const Prism prism = random_prism(random, false);
    const Affine3 map =
        random.chance(0.5) ? Affine3::rotate({0, 0, 0}) : Affine3::rotate(90 * random.in_cube() + Vec3{10, 0, 0});
    const auto placement = Placement::create(BoundedAffine3::elementary(map), {0, 0, 0});
    ASSERT_TRUE(placement);
    // Around a place on an edge, mostly.
    const auto& loop = prism.outline.loops[random.below(static_cast<int>(prism.outline.loops.size()))];
    const std::size_t at = static_cast<std::size_t>(random.below(static_cast<int>(loop.size())));
    const OutlineCorner &a = loop[at], &b = loop[(at + 1) % loop.size()];
    // Beyond its ends, too, where its line goes on and the outline does not.
    const double s = random.chance(0.3) ? 0 : random.uniform(-0.1, 1.1);
    const Vec3 local{a.x + s * (b.x - a.x), a.y + s * (b.y - a.y), random.uniform(prism.low(), prism.high())};
    const Vec3 middle = map.point(local), half = random.magnitude(-5, -1) * Vec3{1, random.uniform(0.3, 1), 1};
    const Box3 box{middle - half, middle + half};
    std::vector<Plane> planes;
    const PlanarPart part = prism.planes_within(placement->to_local(box), planes);
    if (part == PlanarPart::unknown) continue;
    const bool is_notch = part == PlanarPart::above_any;
    notches += is_notch && planes.size() > 1;
    ++pieces;
    corners += planes.size() > 1;
    for (const Plane& plane : planes) EXPECT_NEAR(length(plane.normal), 1, 1e-12);
    for (int i = 0; i < 50; ++i, ++points) {
      const Vec3 p = placement->point_to_local(box.center() + half * random.in_cube());
      double beyond = -HUGE_VAL;
      for (const Plane& plane : planes) beyond = std::max(beyond, dot(plane.normal, p) - plane.d);
      const double across = distance_within(prism.outline, p.x, p.y);
      const double along = std::max(prism.low() - p.z, p.z - prism.high());
      if (std::fabs(across) < 1e-9 || std::fabs(along) < 1e-9) continue;
      ASSERT_EQ((beyond < 0) != is_notch, across < 0 && along < 0) << "round " << round << " point " << i;
      inside += across < 0 && along < 0;
    }
  }
  EXPECT_GT(pieces, 6000);
  EXPECT_GT(corners, 500);
  EXPECT_GT(notches, 200);
  EXPECT_GT(inside, points / 4);
  EXPECT_LT(inside, 3 * points / 4);
}

// A turned box beside the end of an edge, whose line it meets where the outline has turned away.
TEST(PrismPieces, EdgesThatEndBeforeTheBoxBoundNothing) {
  Prism prism;
  prism.outline = {{{{-1, 0, 0}, {0, 0, 0}, {1, -1, 0}, {-1, -1, 0}}}};
  prism.prepare();
  const Affine3 turn = Affine3::rotate({0, 0, 45});
  const auto placement = Placement::create(BoundedAffine3::elementary(turn), {0, 0, 0});
  const Vec3 middle = turn.point({0.3, 0.3, 0.5}), half{0.28, 0.28, 0.2};
  const LocalBox box = placement->to_local(Box3{middle - half, middle + half});
  ASSERT_EQ(prism.classify(box), Region::straddles) << "or nobody would ask";
  std::vector<Plane> planes;
  EXPECT_EQ(prism.planes_within(box, planes), PlanarPart::unknown);
}

// Where a prism is said to be what a few walls bound, the way from the place that is known tells of every point.
TEST(PrismPieces, WallsTellThePrismWithinTheirBox) {
  Random random(93);
  outlines::WallParts<SweptPart> parts;
  for (int round = 0; round < 20000; ++round) {
    Prism prism = random_prism(random, true);
    if (random.chance(0.5)) prism.scale = random.uniform(0.3, 2);
    const OutlineCorner& corner = outlines::random_corner(prism.outline, random);
    const double z = random.uniform(prism.low(), prism.high());
    const double s = 1 + (prism.scale - 1) * (z - prism.low()) / prism.h;
    const SweptPart& part = parts.part;
    parts.check(prism, Vec3{s * corner.x, s * corner.y, z} + 0.1 * random.in_cube(), 0, random,
                [&](const Vec3& p) -> std::optional<Vec2> {
                  const double scale = part.scale + part.scale_slope * p.z;
                  EXPECT_GE(scale, part.least_scale);
                  EXPECT_LE(scale, part.most_scale);
                  if (!(part.low < p.z && p.z < part.high)) return std::nullopt;
                  return Vec2{p.x / scale, p.y / scale};
                });
  }
  parts.expect_many();
}

// A crossing that is found from its neighbourhood is that of spans(), to the last bit.
TEST(PrismPieces, CrossingsFoundFromNearbyAreThoseOfSpans) {
  Random random(92);
  outlines::NearbyCrossings crossings;
  for (int round = 0; round < 15000; ++round) {
    Prism prism = random_prism(random, random.chance(0.5));
    if (random.chance(0.3)) prism.scale = random.uniform(0.3, 2);
    for (int i = 0; i < 10; ++i) {
      LocalRay ray;
      const Vec3 aim = 2 * random.in_cube();
      ray.direction = random.chance(0.1) ? Vec3{0, 0, 1} : random.direction();
      ray.origin = aim + 0.1 * random.in_cube();
      const double error = random.magnitude(-15, -10);
      ray.origin_error = {error, error, error};
      ray.direction_error = 0.1 * ray.origin_error;
      crossings.check(prism, ray, random);
      crossings.check_from_start(prism, ray, random);
    }
  }
  EXPECT_GT(crossings.found, crossings.asked / 2);
}

}  // namespace
}  // namespace tenon
