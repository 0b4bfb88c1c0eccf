#include "render/solid_texture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tenon {
namespace {

TEST(SolidTexture, CheckerChangesFromCubeToCube) {
  SolidTexture t;
  t.kind = TextureKind::checker;
  t.size = 2;
  EXPECT_EQ(second_share(t, {0.1, 0.1, 0.1}), 0);
  EXPECT_EQ(second_share(t, {2.1, 0.1, 0.1}), 1);
  EXPECT_EQ(second_share(t, {2.1, 2.1, 0.1}), 0);
  EXPECT_EQ(second_share(t, {-1.9, 2.1, 2.1}), 1);
  EXPECT_EQ(second_share(t, {0.9, 0, 0}), second_share(t, {-0.9, 0, 0})) << "one cube around the origin";
}

TEST(SolidTexture, MovesWithItsFrame) {
  for (const TextureKind kind : {TextureKind::checker, TextureKind::marble, TextureKind::wood, TextureKind::noise}) {
    SolidTexture here, there;
    here.kind = there.kind = kind;
    const Affine3 move = Affine3::translate({3, -7, 2}) * Affine3::rotate({10, 50, 70});
    there.texture_from_world = *move.inverse();
    for (double x : {0.13, 0.77, 1.41}) {
      const Vec3 p{x, 2 * x - 1, 0.3 - x};
      EXPECT_NEAR(second_share(here, p), second_share(there, move.point(p)), 1e-12);
    }
  }
}

TEST(GradientNoise, IsZeroAtWholeCoordinatesAndSmoothBetween) {
  double least = 1, most = -1;
  for (int i = -20; i < 20; ++i) {
    EXPECT_EQ(gradient_noise({1.0 * i, 2.0 * i, 7.0 - i}), 0);
    for (double f = 0; f < 1; f += 0.01) {
      const Vec3 p{i + f, 0.37 * i + 0.3, 0.61};
      const double here = gradient_noise(p);
      least = std::min(least, here);
      most = std::max(most, here);
      EXPECT_NEAR(gradient_noise(p + Vec3{1e-7, 0, 0}), here, 1e-6);
    }
  }
  EXPECT_LT(least, -0.3);
  EXPECT_GT(most, 0.3);
  EXPECT_GE(least, -1.5);
  EXPECT_LE(most, 1.5);
}

}  // namespace
}  // namespace tenon
