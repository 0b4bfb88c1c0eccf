#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "primitive/check_crossings.h"
#include "primitive/local_ray.h"
#include "primitive/next_crossing.h"
#include "support/random.h"
#include "tenon/math/box3.h"

namespace tenon {

/// What a solid says of the crossings along rays, one after another, against spans(), to the last bit.
struct NextCrossingChecks {
  int rays = 0, asked = 0, unsure = 0, found = 0, from_faces = 0;

  /// @param solid  spans(ray, out) and next_crossing(ray, search)
  template <class Solid>
  void check(const Solid& solid, LocalRay ray, double size, Random& random) {
    Spans whole;
    solid.spans(ray, whole);
    ++rays;
    const double length = tenon::length(ray.direction);
    double begin = random.uniform(-1, 1) * 2 * size / length;
    if (random.chance(0.4) && !whole.empty()) {
      const Crossing start = whole[static_cast<std::size_t>(random.below(static_cast<int>(whole.size())))];
      ray.origin = ray.origin + start.t * ray.direction;
      if (random.chance(0.5)) ray.direction = length * random.direction();
      const double error = start.bound * max_component(abs(ray.direction)) + 1e-15 * max_component(abs(ray.origin));
      ray.origin_error = {error, error, error};
      ray.on_face = static_cast<int>(start.face);
      begin = 0;
      ++from_faces;
      whole.clear();
      solid.spans(ray, whole);
    }
    const double near = random.magnitude(-9, -5) * size / length;
    const auto where = [&] { return describe(whole) + describe(ray.origin, ray.direction); };
    double from = random.chance(0.5) ? begin : begin + random.uniform(0, 1) * size / length;
    for (int steps = 0; steps < 100; ++steps) {
      const NextCrossing next = solid.next_crossing(ray, {begin, from, near});
      ++asked;
      if (next.kind == NextCrossing::Kind::unsure) {
        ++unsure;
        return;
      }
      // What lies at the place itself may be on either side.
      const auto is_ahead = [&](const Crossing& c) { return c.t > from && !(std::fabs(c.t - from) <= c.bound); };
      const auto expected = std::find_if(whole.begin(), whole.end(), is_ahead);
      if (next.kind == NextCrossing::Kind::nothing) {
        ASSERT_EQ(expected, whole.end()) << from << where();
        return;
      }
      ++found;
      ASSERT_NE(expected, whole.end()) << where();
      ASSERT_EQ(expected->t, next.crossing.t) << from << where();
      ASSERT_EQ(expected->face, next.crossing.face) << where();
      ASSERT_EQ(expected->entering, next.crossing.entering) << where();
      ASSERT_LE(next.crossing.bound, 0.5 * near);
      ASSERT_LE(expected->bound, next.crossing.bound * (1 + 1e-9)) << where();
      for (const Crossing& c : whole) {
        if (&c == &*expected) continue;
        ASSERT_GT(std::fabs(c.t - expected->t), near) << where();
      }
      from = next.crossing.t + 0.5 * near;
    }
  }
};

}  // namespace tenon
