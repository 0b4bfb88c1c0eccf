#include "primitive/placement.h"

#include <gtest/gtest.h>

#include "primitive/check_crossings.h"
#include "primitive/random_placement.h"
#include "primitive/random_solid.h"

namespace tenon {
namespace {

using exact::Line;
using exact::Quad;
using exact::Vec;

class Placed : public EveryKind {};

double least(const Vec3& v) {
  return std::min({v.x, v.y, v.z});
}

// Every kind under shears, mirrors, turns, uneven, tiny and huge scales, far away: crossings agree with the exact
// product of the transformations, inverted exactly. Tolerance 0, so that all of the bound is what rounding needs.
TEST_P(Placed, CrossingsAgreeWithTheExactMap) {
  Random random(seed());
  int hits = 0;
  for (int n = 0; n < 500; ++n) {
    const RandomSolid solid(kind(), random);
    const oracle::Solid<Quad> definition(kind().name, solid.values);
    const RandomChain chain(random);
    const auto placement = Placement::create(chain.map, solid.bounds.center());
    ASSERT_TRUE(placement);
    const exact::Map inverse = chain.truth.inverse();
    const Box3 bounds = world_bounds(solid.store, solid.id, chain.map);
    for (int i = 0; i < 40; ++i) {
      const bool grazing = random.chance(0.3);
      const LocalRay local = grazing ? solid.grazing_ray(random) : solid.ray(random);
      const Affine3& map = placement->world_from_local();
      const double far = random.chance(0.2) ? random.magnitude(0, 4) : 0;
      Ray ray{map.point(local.origin), map.direction(local.direction)};
      ray.origin = ray.at(-far * solid.size / length(local.direction));

      const LocalRay mapped = placement->to_local(ray, 0, -1).ray;
      const double error = length(mapped.origin_error);
      // A solid that is smaller than the rounding of its place has no crossings to speak of.
      if (kind().bounded && error > 1e-3 * least(solid.bounds.size())) continue;
      Spans out;
      spans(solid.store, solid.id, *placement, LocalRay{ray.origin, ray.direction, {}, {}, -1}, out);
      hits += !out.empty();
      const Line<Quad> line{inverse.point(Vec<Quad>(ray.origin)), inverse.direction(Vec<Quad>(ray.direction))};
      const Vec3 d = line.direction.rounded();
      const double middle = static_cast<double>(dot(Vec<Quad>(solid.bounds.center()) - line.origin, line.direction) /
                                                dot(line.direction, line.direction));
      const auto problem = check_against(definition, line, out, middle, solid.size / length(d), random, 2,
                                         {error, length(mapped.direction_error)});
      ASSERT_FALSE(problem) << *problem << describe(ray.origin, ray.direction) << describe(solid.values);
      for (const Crossing& c : out) {
        if (!kind().bounded || c.bound > 0.1 * solid.size / length(d)) continue;
        const double slack = (c.bound + 1e-15 * std::fabs(c.t)) * length(ray.direction) + 1e-15 * length(ray.origin);
        EXPECT_TRUE(grown(bounds, slack).contains(ray.at(c.t)))
            << describe(out) << describe(ray.origin, ray.direction) << describe(solid.values);
      }
    }
  }
  EXPECT_GT(hits, 5'000);
}

// Boxes of the world, seen from the local frame: `outside` and `inside` hold at the corners and at places within.
TEST_P(Placed, ClassificationIsNeverWrong) {
  Random random(seed());
  int certain = 0, clear = 0, decided = 0;
  for (int n = 0; n < 400; ++n) {
    const RandomSolid solid(kind(), random);
    const oracle::Solid<Quad> definition(kind().name, solid.values);
    const RandomChain chain(random);
    const auto placement = Placement::create(chain.map, solid.bounds.center());
    ASSERT_TRUE(placement);
    const exact::Map inverse = chain.truth.inverse();
    const Box3 bounds = kind().bounded ? world_bounds(solid.store, solid.id, chain.map) : Box3::empty();
    for (int i = 0; i < 50; ++i) {
      const Vec3 center = placement->world_from_local().point(solid.point(random));
      const Vec3 extent = kind().bounded ? bounds.size() : Vec3{1, 1, 1} * length(center - chain.map.map.translation());
      const double scale = random.magnitude(-3, -0.2);
      const Vec3 half = scale * extent * Vec3{random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
      const Box3 box{center - half, center + half};
      const LocalBox local = placement->to_local(box);
      const Region region = classify(solid.store, solid.id, local);

      // Which of `count` places are inside, in the box grown by a factor.
      const auto inside_of = [&](int count, double factor) {
        int inside = 0;
        for (int k = 0; k < count; ++k) {
          Vec3 at = random.in_cube();
          if (k < 8) at = {(k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0, (k & 4) != 0 ? 1.0 : -1.0};
          Vec3 p = center + factor * at * half;
          if (factor == 1) p = max(box.lower, min(box.upper, p));
          if (factor == 1 && k < 8) {
            p = {at.x > 0 ? box.upper.x : box.lower.x, at.y > 0 ? box.upper.y : box.lower.y,
                 at.z > 0 ? box.upper.z : box.lower.z};
          }
          inside += definition.contains(inverse.point(Vec<Quad>(p)));
        }
        return inside;
      };
      if (region != Region::straddles) {
        ++certain;
        ASSERT_EQ(inside_of(20, 1), region == Region::inside ? 20 : 0)
            << describe(box.lower, box.upper) << describe(solid.values);
      }
      // A small box that is clear of the surface even at twice its size should be decided.
      if (scale > 0.05) continue;
      const int inside = inside_of(40, 2);
      if (inside != 0 && inside != 40) continue;
      ++clear;
      decided += region != Region::straddles;
    }
  }
  EXPECT_GT(certain, 5'000);
  EXPECT_GT(decided, 0.9 * clear) << "of " << clear;
  RecordProperty("decided_of_clear", std::to_string(static_cast<double>(decided) / clear));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Placed, EveryKind::all(), EveryKind::label);

TEST(BoundedAffine3, ErrorsHoldTheExactProduct) {
  Random random(5);
  for (int n = 0; n < 5'000; ++n) {
    const RandomChain chain(random);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        const double error = static_cast<double>(exact::absolute(chain.truth.m[i][j] - Quad(chain.map.map.m[i][j])));
        EXPECT_LE(error, chain.map.error.m[i][j] * (1 + 1e-15));
      }
    }
  }
}

TEST(BoundedAffine3, ExactMapsStayExact) {
  BoundedAffine3 map;
  for (const Affine3& step :
       {Affine3::translate({0.5, -3, 1e6}), Affine3::scale({2, 0.25, -1}), Affine3::rotate({90, 0, 180}),
        Affine3::mirror({0, 1, 0}), Affine3::translate({1, 2, 3})}) {
    map = map * BoundedAffine3::elementary(step);
  }
  for (const auto& row : map.error.m) {
    for (const double error : row) EXPECT_EQ(error, 0);
  }
}

TEST(BoundedAffine3, ErrorsOfNestedTurnsGrowWithTheirNumber) {
  BoundedAffine3 map;
  for (int i = 0; i < 10'000; ++i) map = map * BoundedAffine3::elementary(Affine3::rotate({12, 7, 3}));
  for (const auto& row : map.error.m) {
    for (std::size_t j = 0; j < 3; ++j) EXPECT_LT(row[j], 10'000 * 100 * unit_roundoff);
  }
}

TEST(Placement, RefusesWhatFlattens) {
  const auto create = [](const Affine3& map) {
    return Placement::create(BoundedAffine3::elementary(map), {}).has_value();
  };
  EXPECT_TRUE(create({}));
  EXPECT_TRUE(create(Affine3::scale({1e-30, 1, 1e30})));
  EXPECT_FALSE(create(Affine3::scale({1, 0, 1})));
  EXPECT_FALSE(create({{{{1, 2, 3, 0}, {4, 5, 6, 0}, {7, 8, 9, 0}}}}));
  EXPECT_FALSE(create(Affine3::translate({0, std::numeric_limits<double>::quiet_NaN(), 0})));
  EXPECT_FALSE(create(Affine3::scale({1, 1, std::numeric_limits<double>::infinity()})));
  // Flat within the error of its entries.
  EXPECT_FALSE(create({{{{1, 1, 0, 0}, {1, 1 + 0x1p-52, 0, 0}, {0, 0, 1, 0}}}}));
}

TEST(Placement, IdentityHasNextToNoError) {
  const auto placement = Placement::create({}, {0.5, 0.5, 0.5});
  const auto mapped = placement->to_local({{0, 0, 4}, {0, 0, -1}}, 0, -1);
  EXPECT_EQ(mapped.shift, 3.5);
  EXPECT_EQ(mapped.ray.origin, (Vec3{0, 0, 0.5}));
  EXPECT_EQ(mapped.ray.direction, (Vec3{0, 0, -1}));
  EXPECT_EQ(mapped.ray.direction_error.x, 0);
  EXPECT_LT(mapped.ray.origin_error.z, 1e-14);
}

TEST(Placement, MirroredNormalsPointOutward) {
  const auto placement = Placement::create(BoundedAffine3::elementary(Affine3::scale({-2, 1, 1})), {});
  EXPECT_EQ(placement->normal_to_world({1, 0, 0}), (Vec3{-1, 0, 0}));
}

TEST(WorldBounds, AreTightUnderAffineMaps) {
  PrimitiveStore store;
  const auto add = [&store](std::string_view kind, std::vector<FieldValue> values) {
    return *store.add(*PrimitiveStore::find_kind(kind), values);
  };
  const auto bounds = [&store](PrimitiveId id, const Affine3& map) {
    return world_bounds(store, id, BoundedAffine3::elementary(map));
  };
  const auto near = [](const Box3& box, const Vec3& lower, const Vec3& upper) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(box.lower[i], lower[i], 1e-12);
      EXPECT_NEAR(box.upper[i], upper[i], 1e-12);
      EXPECT_LE(box.lower[i], lower[i]);
      EXPECT_GE(box.upper[i], upper[i]);
    }
  };
  // A ball stays a ball; a stretched and turned one reaches as far as the rows of its map are long.
  const PrimitiveId ball = add("sphere", {1.0});
  near(bounds(ball, Affine3::rotate({10, 20, 30})), {-1, -1, -1}, {1, 1, 1});
  near(bounds(ball, Affine3::rotate({0, 0, 45}) * Affine3::scale({3, 1, 1})), {-std::sqrt(5), -std::sqrt(5), -1},
       {std::sqrt(5), std::sqrt(5), 1});
  const PrimitiveId ring = add("torus", {2.0, 0.5});
  near(bounds(ring, Affine3::rotate({90, 0, 0})), {-2.5, -0.5, -2.5}, {2.5, 0.5, 2.5});
  // Lying down at 45 degrees, h = 2, r = 1: (h + 2 r) / sqrt(2) wide from the lower rim.
  const PrimitiveId post = add("cylinder", {2.0, 1.0, true});
  near(bounds(post, Affine3::rotate({0, 45, 0})), {-std::sqrt(2), -1, -std::sqrt(2)}, {std::sqrt(2), 1, std::sqrt(2)});
  // A paraboloid z = x² + y² on its side: below the rim it bulges to the tangent, sqrt(2) / 8 beyond the apex.
  const PrimitiveId dish = add("paraboloid", {1.0, 1.0});
  const Box3 tilted = bounds(dish, Affine3::rotate({0, 45, 0}));
  EXPECT_NEAR(tilted.lower.z, -std::sqrt(2) / 8, 1e-12);
  const PrimitiveId half = add("halfspace", {Vec3{0, 0, 2}, 6.0});
  EXPECT_NEAR(bounds(half, Affine3::translate({0, 0, 1})).upper.z, 4, 1e-12);
  EXPECT_EQ(bounds(half, {}).lower.z, -Box3::inf);
  EXPECT_EQ(bounds(half, {}).upper.x, Box3::inf);
}

}  // namespace
}  // namespace tenon
