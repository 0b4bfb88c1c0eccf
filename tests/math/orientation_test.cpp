#include "math/orientation.h"

#include <gtest/gtest.h>

#include "support/random.h"

namespace tenon {
namespace {

// Coordinates are whole numbers below 2^39, so that 128 bits hold every product.
__extension__ typedef __int128 Whole;

int sign_of(Whole value) {
  return (value > 0) - (value < 0);
}

int exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto entry = [&d](const Vec3& p, int i) { return static_cast<Whole>(p[i]) - static_cast<Whole>(d[i]); };
  Whole sum = 0;
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    sum += entry(a, k) * (entry(b, i) * entry(c, j) - entry(b, j) * entry(c, i));
  }
  return sign_of(sum);
}

int exact(const Vec2& a, const Vec2& b, const Vec2& c) {
  const auto whole = [](double x) { return static_cast<Whole>(x); };
  return sign_of((whole(b.x) - whole(a.x)) * (whole(c.y) - whole(a.y)) -
                 (whole(b.y) - whole(a.y)) * (whole(c.x) - whole(a.x)));
}

TEST(Orientation, IsExactForPointsOnAndBesideAPlaneOrALine) {
  Random random(11);
  const auto whole = [&] { return std::floor(random.uniform(-1, 1) * random.magnitude(0, 10.7)); };
  const auto step = [&] { return 1.0 * (random.below(3) - 1); };
  int level = 0;
  for (int i = 0; i < 100000; ++i) {
    const Vec3 a{whole(), whole(), whole()}, b{whole(), whole(), whole()}, c{whole(), whole(), whole()};
    // On the plane through the three, or a step beside it, to all sides or one.
    const Vec3 d = a + 2.0 * (b - a) - 1.0 * (c - a) + Vec3{step(), step(), step()} * (1.0 * random.below(2));
    const int expected = exact(a, b, c, d);
    ASSERT_EQ(orientation(a, b, c, d), expected) << i;
    level += expected == 0;
    const Vec2 p{a.x, a.y}, q{b.x, b.y}, r = p + 2.0 * (q - p) + (1.0 * random.below(2)) * Vec2{step(), step()};
    ASSERT_EQ(orientation(p, q, r), exact(p, q, r)) << i;
  }
  EXPECT_GT(level, 50000);
  EXPECT_EQ(orientation({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}), 1);
  EXPECT_EQ(orientation(Vec2{0, 0}, {1, 0}, {0, 1}), 1);
}

}  // namespace
}  // namespace tenon
