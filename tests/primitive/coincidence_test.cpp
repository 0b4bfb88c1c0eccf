#include <gtest/gtest.h>

#include "primitive/check_crossings.h"
#include "primitive/random_placement.h"
#include "primitive/random_solid.h"

/// Two versions of one solid, placed by two chains of transformations whose exact products are equal, so that they
/// differ by rounding alone. What quadratic.h promises: whatever one sees, the other sees within the bounds of both, or
/// the chord's two ends count as one.
namespace tenon {
namespace {

class Coincidence : public EveryKind {};

using exact::Line;
using exact::Quad;
using exact::Vec;

// A crossing known to no better than its own distance may as well have gone to infinity: the line is all but parallel.
bool is_anywhere(const Crossing& c) {
  return c.bound > 0.25 * std::fabs(c.t);
}

bool meet(const Crossing& a, const Crossing& b) {
  if (a.t == b.t) return true;
  if (std::isinf(a.t)) return is_anywhere(b);
  if (std::isinf(b.t)) return is_anywhere(a);
  return std::fabs(a.t - b.t) <= a.bound + b.bound;
}

// Every crossing of `a` either meets one of `b` in the same sense, or its other end (before or after it).
std::optional<std::string> unmatched(const Spans& a, const Spans& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    bool matched = (i > 0 && meet(a[i], a[i - 1])) || (i + 1 < a.size() && meet(a[i], a[i + 1]));
    for (const Crossing& c : b) matched |= c.entering == a[i].entering && meet(c, a[i]);
    if (!matched) return "one sees" + describe(a) + "\nthe other" + describe(b);
  }
  return {};
}

// A line in a flat face, or along a straight line of a curved one, crosses it nowhere that an interval could hold; for
// it inside and outside are both right.
bool lies_in_surface(const RandomSolid& solid, const Placement& placement, const Ray& ray, double tolerance,
                     const Spans& spans) {
  const oracle::Solid<Quad> definition(solid.store.kind(solid.id).name, solid.values);
  const auto [local, shift] = placement.to_local(ray, tolerance, -1);
  const Line<Quad> line{Vec<Quad>(local.origin), Vec<Quad>(local.direction)};
  const RayErrors errors{length(local.origin_error), length(local.direction_error)};
  for (std::size_t i = 0; i + 1 < spans.size(); i += 2) {
    const bool ends = std::isfinite(spans[i].t) && std::isfinite(spans[i + 1].t);
    const double t = ends ? 0.5 * (spans[i].t + spans[i + 1].t) - shift : 0;
    if (decides_nothing(definition, line, t, solid.size / length(local.direction), errors, 0)) return true;
  }
  return false;
}

ExactStep rotation(const Vec3& degrees) {
  return {Affine3::rotate(degrees), exact::Map::rotate(degrees)};
}

TEST_P(Coincidence, WhatOneChainSeesTheOtherSeesToo) {
  Random random(seed());
  int disagreements = 0;
  for (int n = 0; n < 400; ++n) {
    const RandomSolid solid(kind(), random);
    // translate(a) rotate(angles) scale(s), once in one step each, once in several. Halves and sums are exact.
    const double magnitude = std::ldexp(1.0, random.below(24) - 4);
    const Vec3 a = magnitude / 64 * Vec3{1.0 * random.below(64), 1.0 * random.below(64), 1.0 * random.below(64)};
    const Vec3 b = magnitude / 64 * Vec3{1.0 * random.below(64), 1.0 * random.below(64), 1.0 * random.below(64)};
    const Vec3 angles{1.0 * random.below(360), 1.0 * random.below(360), 1.0 * random.below(360)};
    const Vec3 s{random.magnitude(-1, 1), random.magnitude(-1, 1), random.magnitude(-1, 1)};
    RandomChain one, other;
    one.append(written(Affine3::translate(a + b)));
    one.append(rotation(angles));
    one.append(written(Affine3::scale(s)));
    other.append(written(Affine3::translate(a)));
    other.append(written(Affine3::translate(b)));
    other.append(rotation({0, 0, angles.z / 2}));
    other.append(rotation({0, 0, angles.z / 2}));
    other.append(rotation({angles.x, angles.y, 0}));
    other.append(written(Affine3::scale(2 * s)));
    other.append(written(Affine3::scale({0.5, 0.5, 0.5})));
    const auto first = Placement::create(one.map, solid.bounds.center());
    const auto second = Placement::create(other.map, solid.bounds.center());
    ASSERT_TRUE(first && second);
    for (int i = 0; i < 200; ++i) {
      const LocalRay local = random.chance(0.8) ? solid.grazing_ray(random) : solid.ray(random);
      const Ray ray{first->world_from_local().point(local.origin),
                    first->world_from_local().direction(local.direction)};
      // The second may be known much less well than the first.
      const double tolerance = random.chance(0.5) ? 0 : solid.size * random.magnitude(-16, -9);
      Spans x, y;
      // Along the whole line.
      LocalRay line{ray.origin, ray.direction, {}, {}, -1};
      spans(solid.store, solid.id, *first, line, x);
      line.origin_error = tolerance * Vec3{1, 1, 1};
      spans(solid.store, solid.id, *second, line, y);
      disagreements += x.size() != y.size();
      const auto xy = unmatched(x, y), yx = unmatched(y, x);
      if ((xy || yx) && lies_in_surface(solid, *second, ray, tolerance, x.empty() ? y : x)) continue;
      ASSERT_FALSE(xy) << *xy << describe(ray.origin, ray.direction) << describe(solid.values);
      ASSERT_FALSE(yx) << *yx << describe(ray.origin, ray.direction) << describe(solid.values);
    }
  }
  // The test means something: chords that only one of them sees do occur.
  EXPECT_GT(disagreements, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Coincidence, EveryKind::all(), EveryKind::label);

}  // namespace
}  // namespace tenon
