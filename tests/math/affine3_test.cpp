#include "tenon/math/affine3.h"

#include <gtest/gtest.h>

#include "support/quad.h"
#include "support/random.h"
#include "tenon/math/rounding.h"

namespace tenon {
namespace {

TEST(Degrees, MultiplesOf90And30And60AreExact) {
  for (int turn = -3; turn <= 3; ++turn) {
    const double full = 360.0 * turn;
    EXPECT_EQ(sin_degrees(full), 0);
    EXPECT_EQ(sin_degrees(full + 30), 0.5);
    EXPECT_EQ(sin_degrees(full + 90), 1);
    EXPECT_EQ(sin_degrees(full + 150), 0.5);
    EXPECT_EQ(sin_degrees(full + 180), 0);
    EXPECT_EQ(sin_degrees(full + 210), -0.5);
    EXPECT_EQ(sin_degrees(full + 270), -1);
    EXPECT_EQ(sin_degrees(full + 330), -0.5);
    EXPECT_EQ(cos_degrees(full), 1);
    EXPECT_EQ(cos_degrees(full + 60), 0.5);
    EXPECT_EQ(cos_degrees(full + 90), 0);
    EXPECT_EQ(cos_degrees(full + 120), -0.5);
    EXPECT_EQ(cos_degrees(full + 180), -1);
    EXPECT_EQ(cos_degrees(full + 240), -0.5);
    EXPECT_EQ(cos_degrees(full + 270), 0);
    EXPECT_EQ(cos_degrees(full + 300), 0.5);
  }
}

TEST(Degrees, AgreeWith113BitsToTwoUnits) {
  Random random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double a = random.chance(0.2) ? std::round(random.uniform(-1000, 1000)) : random.uniform(-1000, 1000);
    const double s = static_cast<double>(exact::sine(exact::Quad(a))),
                 c = static_cast<double>(exact::cosine(exact::Quad(a)));
    EXPECT_NEAR(sin_degrees(a), s, 4 * unit_roundoff * std::fabs(s)) << a;
    EXPECT_NEAR(cos_degrees(a), c, 4 * unit_roundoff * std::fabs(c)) << a;
  }
}

void expect_near(const Affine3& a, const exact::Map& b, double tolerance) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_NEAR(a.m[i][j], static_cast<double>(b.m[i][j]), tolerance) << i << ' ' << j;
  }
}

Vec3 truth_row(const exact::Map& map, std::size_t i) {
  return exact::Vec<exact::Quad>(map.m[i][0], map.m[i][1], map.m[i][2]).rounded();
}

TEST(Affine3, RotatesAroundXThenYThenZ) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = 400 * random.in_cube();
    // BoundedAffine3::elementary counts on 16u of the largest entry in a row.
    const Affine3 rotation = Affine3::rotate(a);
    const exact::Map truth = exact::Map::rotate(a);
    for (std::size_t r = 0; r < 3; ++r) {
      const double largest = max_component(abs(truth_row(truth, r)));
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(rotation.m[r][c], static_cast<double>(truth.m[r][c]), 4 * unit_roundoff * largest);
      }
    }
  }
  // x to y by a quarter turn around z; and x is turned before z.
  EXPECT_EQ(Affine3::rotate({0, 0, 90}).point({1, 0, 0}), (Vec3{0, 1, 0}));
  EXPECT_EQ(Affine3::rotate({90, 0, 90}).point({0, 1, 0}), (Vec3{0, 0, 1}));
}

TEST(Affine3, RotatesAroundAnAxis) {
  expect_near(Affine3::rotate(37, {0, 0, 5}), exact::Map::around(2, 37), 2.3 * unit_roundoff);
  expect_near(Affine3::rotate(-137, {0, 1e-9, 0}), exact::Map::around(1, -137), 2.3 * unit_roundoff);
  expect_near(Affine3::rotate(120, {1, 1, 1}), exact::Map(Affine3{{{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}}}),
              1e-15);
  EXPECT_EQ(Affine3::rotate(10, {0, 0, 0}), Affine3{});
  EXPECT_EQ(Affine3::rotate(90, {0, 0, 1}).point({1, 0, 0}), (Vec3{0, 1, 0}));
}

TEST(Affine3, MirrorsInAPlane) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 n = random.magnitude(-3, 3) * random.direction();
    const exact::Vec<exact::Quad> e(n);
    exact::Map truth;
    const exact::Quad c[3] = {e.x, e.y, e.z};
    for (int r = 0; r < 3; ++r) {
      for (int k = 0; k < 3; ++k) truth.m[r][k] -= 2 * c[r] * c[k] / dot(e, e);
    }
    expect_near(Affine3::mirror(n), truth, 6 * unit_roundoff);
  }
  EXPECT_EQ(Affine3::mirror({2, 0, 0}), Affine3::scale({-1, 1, 1}));
  EXPECT_EQ(Affine3::mirror({0, 0, 0}), Affine3{});
  const Affine3 m = Affine3::mirror({1, 2, 3});
  expect_near(m * m, exact::Map(), 1e-15);
  EXPECT_NEAR(m.determinant(), -1, 1e-15);
}

TEST(Affine3, InvertsWhatDoesNotFlatten) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Affine3 a = Affine3::translate(random.magnitude(-6, 6) * random.in_cube()) *
                      Affine3::rotate(180 * random.in_cube()) *
                      Affine3::scale({random.magnitude(-9, 9), -random.magnitude(-9, 9), random.magnitude(-9, 9)});
    const auto inverse = a.inverse();
    ASSERT_TRUE(inverse);
    const exact::Map truth = exact::Map(a).inverse();
    for (std::size_t r = 0; r < 3; ++r) {
      const double row = max_component(abs(truth_row(truth, r)));
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(inverse->m[r][c], static_cast<double>(truth.m[r][c]), 1e-13 * row);
    }
  }
  EXPECT_FALSE(Affine3::scale({1, 0, 1}).inverse());
  EXPECT_FALSE(Affine3::scale({1, std::numeric_limits<double>::infinity(), 1}).inverse());
  EXPECT_FALSE((Affine3{{{{1, 2, 3, 0}, {2, 4, 6, 0}, {0, 0, 1, 0}}}}).inverse());
}

}  // namespace
}  // namespace tenon
