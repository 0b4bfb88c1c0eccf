#include <gtest/gtest.h>

#include "primitive/random_solid.h"
#include "primitive/torus_quartic.h"

namespace tenon {
namespace {

// What spans() reports is found again from anywhere near it, but from near the middle between two steps, and where the
// slope is too small to tell.
TEST(SettledTorusRoot, IsTheDoubleThatSpansReports) {
  constexpr std::uint64_t seed = 11;
  Random random(seed);
  int crossings = 0, found = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", trial " << trial);
    const double R = random.magnitude(-2, 2), r = R * random.uniform(0.02, 1);
    PrimitiveStore store;
    const auto id = store.add(*PrimitiveStore::find_kind("torus"), std::vector<FieldValue>{R, r});
    ASSERT_TRUE(id);
    LocalRay ray;
    ray.direction = random.magnitude(-3, 3) * random.direction();
    ray.origin = (R + r) * random.in_cube() - random.uniform(0, 3) * R / length(ray.direction) * ray.direction;
    Spans spans_found;
    spans(store, *id, ray, spans_found);
    for (const Crossing& c : spans_found) {
      ++crossings;
      const SettledTorusRoot at(R, r, ray, c.t);
      const double off = at.step * random.uniform(-0x1p-7, 0x1p-7);
      const double steps = c.t / at.step, from_middle = std::fabs(steps - std::floor(steps) - 0.5);
      if (from_middle < 0x1p-6) continue;
      const SettledTorusRoot root(R, r, ray, c.t + off);
      EXPECT_EQ(root.t, at.t);
      if (!root.settled || root.rising == c.entering || std::fabs(root.t - c.t) > at.step * 0x1p-6) continue;
      ++found;
      EXPECT_EQ(root.t, c.t);
    }
  }
  EXPECT_GT(crossings, 10000);
  EXPECT_GT(found, crossings * 9 / 10);
}

}  // namespace
}  // namespace tenon
