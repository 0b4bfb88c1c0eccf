#include "tenon/render/camera_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/primary_directions.h"
#include "support/instruction_sets.h"

namespace tenon {
namespace {

Camera looking(const Vec3& from, const Vec3& at, const Vec3& up = {0, 0, 1}) {
  Camera camera;
  camera.from = from;
  camera.at = at;
  camera.up = up;
  return camera;
}

void expect_near(const Vec3& a, const Vec3& b, double bound = 1e-14) {
  EXPECT_NEAR(a.x, b.x, bound);
  EXPECT_NEAR(a.y, b.y, bound);
  EXPECT_NEAR(a.z, b.z, bound);
}

TEST(CameraRays, MiddleOfThePictureIsWhereItLooks) {
  const auto rays = CameraRays::create(looking({3, -4, 0}, {0, 0, 0}), 640, 480);
  ASSERT_TRUE(rays.ok());
  const Ray ray = rays->ray(320, 240);
  EXPECT_EQ(ray.origin, (Vec3{3, -4, 0}));
  expect_near(ray.direction, {-0.6, 0.8, 0});
}

TEST(CameraRays, FieldOfViewCoversTheWidth) {
  Camera camera = looking({0, -1, 0}, {0, 0, 0});
  camera.fov = 90;
  const auto rays = CameraRays::create(camera, 200, 100);
  const double h = 1 / std::sqrt(2.0);
  expect_near(rays->ray(200, 50).direction, {h, h, 0});  // right edge, half the height
  expect_near(rays->ray(0, 50).direction, {-h, h, 0});
  // Pixels are square: the upper edge is half as far from the middle as the right one.
  expect_near(rays->ray(100, 0).direction, normalize(Vec3{0, 1, 0.5}));
}

TEST(CameraRays, HalvesAreMirrorImages) {
  const auto rays = CameraRays::create(looking({0, -7, 0}, {0, 0, 0}), 641, 123);
  for (int x = 0; x < 641; ++x) {
    const Vec3 left = rays->ray(x + 0.5, 10.5).direction, right = rays->ray(640 - x + 0.5, 10.5).direction;
    EXPECT_EQ(left.x, -right.x);
    EXPECT_EQ(left.y, right.y);
    EXPECT_EQ(left.z, right.z);
  }
}

TEST(CameraRays, BlocksAreTheSameRaysOnEveryInstructionSet) {
  const auto rays = CameraRays::create(looking({0.3, -7, 2}, {0, 0.1, 0}), 641, 123);
  NumberBlock x{}, y{};
  for (std::size_t i = 0; i < block_size; ++i)
    x[i] = 10.1 * static_cast<double>(i), y[i] = 123 - 1.7 * static_cast<double>(i);
  for_each_instruction_set([&] {
    for (const std::size_t count : {std::size_t{1}, std::size_t{11}, block_size}) {
      Vec3Block direction;
      find_primary_directions(rays->view(), x, y, count, direction);
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(direction[i], rays->ray(x[i], y[i]).direction) << i;
    }
  });
}

TEST(CameraRays, OrthographicCoversItsWidth) {
  Camera camera = looking({0, -5, 0}, {0, 0, 0});
  camera.projection = Projection::orthographic;
  camera.width = 8;
  const auto rays = CameraRays::create(camera, 400, 200);
  expect_near(rays->ray(0, 0).origin, {-4, -5, 2});
  expect_near(rays->ray(400, 200).origin, {4, -5, -2});
  EXPECT_EQ(rays->ray(13, 57).direction, (Vec3{0, 1, 0}));
}

// At distance z a lens of diameter A that is sharp at distance f spreads a place of the picture over a disc of diameter
// A |z - f| / f, evenly; drawn on the plane that is sharp that is the circle of confusion, A |z - f| / z.
TEST(CameraRays, ALensBlursByTheCircleOfConfusion) {
  Camera camera = looking({0, -20, 0}, {0, 0, 0});
  camera.aperture = 3;
  camera.focus = 8;
  const auto rays = CameraRays::create(camera, 300, 200);
  ASSERT_TRUE(rays.ok());
  ASSERT_TRUE(rays->has_lens());
  const Ray center = rays->ray(40, 170);
  constexpr int n = 64;
  for (const double z : {2.0, 8.0, 30.0}) {
    const auto at = [&](const Ray& ray) { return ray.at((z - (ray.origin.y + 20)) / ray.direction.y); };
    const double radius = 0.5 * 3 * std::fabs(z - 8) / 8;
    double farthest = 0, mean_square = 0;
    Vec3 mean;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const Ray ray = rays->ray(40, 170, (i + 0.5) / n, (j + 0.5) / n);
        EXPECT_NEAR(length(ray.direction), 1, 1e-12);
        const Vec3 off = at(ray) - at(center);
        farthest = std::max(farthest, length(off));
        mean_square += dot(off, off) / (n * n);
        mean += off / (n * n);
      }
    }
    EXPECT_LE(farthest, radius + 1e-9) << z;
    EXPECT_GE(farthest, 0.97 * radius) << z;
    EXPECT_NEAR(mean_square, radius * radius / 2, 0.01 * radius * radius + 1e-20) << "evenly over the disc";
    EXPECT_NEAR(length(mean), 0, 1e-9);
  }
}

TEST(CameraRays, WithoutALensEveryPlaceOfItIsThePoint) {
  const auto rays = CameraRays::create(looking({0, -5, 0}, {0, 0, 0}), 30, 20);
  EXPECT_FALSE(rays->has_lens());
  EXPECT_EQ(rays->ray(3, 4, 0.1, 0.9).origin, rays->ray(3, 4).origin);
  EXPECT_EQ(rays->ray(3, 4, 0.1, 0.9).direction, rays->ray(3, 4).direction);
}

TEST(CameraRays, UpAlongTheViewIsReplaced) {
  const auto above = CameraRays::create(looking({0, 0, 5}, {0, 0, 0}), 100, 100);
  ASSERT_TRUE(above.ok());
  EXPECT_GT(above->ray(50, 0).direction.y, 0);    // y at the top
  EXPECT_GT(above->ray(100, 50).direction.x, 0);  // x to the right
  const auto none = CameraRays::create(looking({1, 2, 3}, {3, 2, 1}, {0, 0, 0}), 100, 100);
  EXPECT_NEAR(length(none->ray(0, 0).direction), 1, 1e-14);
  const auto along = CameraRays::create(looking({1, 2, 3}, {4, 4, 4}, {-3e9, -2e9, -1e9}), 100, 100);
  EXPECT_NEAR(length(along->ray(0, 0).direction), 1, 1e-14);
}

TEST(CameraRays, HugeAndTinyScenes) {
  for (double scale : {1e-150, 1e150}) {
    const auto rays = CameraRays::create(looking({0, -5 * scale, 0}, {0, 0, 0}), 10, 10);
    ASSERT_TRUE(rays.ok());
    EXPECT_EQ(rays->ray(5, 5).direction, (Vec3{0, 1, 0}));
  }
}

TEST(CameraRays, ImpossibleCamerasAreErrors) {
  EXPECT_FALSE(CameraRays::create(looking({1, 1, 1}, {1, 1, 1}), 10, 10).ok());
  EXPECT_FALSE(CameraRays::create(looking({std::nan(""), 1, 1}, {1, 1, 1}), 10, 10).ok());
  for (double fov : {0.0, -3.0, 180.0, std::nan("")}) {
    Camera camera;
    camera.fov = fov;
    EXPECT_FALSE(CameraRays::create(camera, 10, 10).ok()) << fov;
  }
  Camera lens = looking({0, -5, 0}, {0, 0, 0});
  lens.aperture = 1;
  EXPECT_TRUE(CameraRays::create(lens, 10, 10).ok());
  lens.focus = -1;
  EXPECT_FALSE(CameraRays::create(lens, 10, 10).ok());
  lens.focus = 1;
  lens.aperture = -1;
  EXPECT_FALSE(CameraRays::create(lens, 10, 10).ok());
  lens.aperture = 1;
  lens.projection = Projection::orthographic;
  EXPECT_FALSE(CameraRays::create(lens, 10, 10).ok());
  for (double width : {0.0, -3.0, std::numeric_limits<double>::infinity()}) {
    Camera camera;
    camera.projection = Projection::orthographic;
    camera.width = width;
    EXPECT_FALSE(CameraRays::create(camera, 10, 10).ok()) << width;
  }
}

}  // namespace
}  // namespace tenon
