#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "primitive/mesh.h"
#include "primitive/next_crossing_checks.h"
#include "primitive/outline_checks.h"
#include "support/meshes.h"

// Crossings of meshes, one after another.
namespace tenon {
namespace {

Mesh prepared(TriangleMesh mesh) {
  Mesh solid;
  solid.mesh = meshes::share(std::move(mesh));
  solid.prepare();
  return solid;
}

LocalRay random_ray(Random& random) {
  LocalRay ray;
  ray.origin = 2 * random.in_cube();
  ray.direction = random.magnitude(-2, 2) * (random.chance(0.3) ? random.direction() : random.in_cube() - ray.origin);
  const double error = random.magnitude(-16, -12);
  ray.origin_error = {error, error, error};
  return ray;
}

TriangleMesh rough_ball(int levels, double size, Random& random) {
  return meshes::star(levels, [&](const Vec3&) { return size * random.uniform(0.8, 1); });
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  return mesh;
}

// Whether it is known that the mesh winds once, or how often it does has to be followed; by either structure; with a
// grid of clear cells or with too few triangles for one.
TEST(MeshNext, ShowsWhatTheWholeLineHas) {
  Random random(11);
  NextCrossingChecks checks;
  for (int n = 0; n < 60; ++n) {
    TriangleMesh mesh = rough_ball(1 + n % 4, 1, random);
    bool winds_once = n % 2 == 0;
    if (n % 3 == 1) mesh = meshes::together(std::move(mesh), turned_inside_out(rough_ball(2, 0.7, random)));
    if (n % 6 == 2) {
      // Within one another, so that some crossings are none of the solid's.
      mesh = meshes::together(std::move(mesh), rough_ball(2, 0.7, random));
      mesh = meshes::together(std::move(mesh), rough_ball(1, 0.5, random));
      winds_once = false;
    }
    if (n % 10 == 9) {
      mesh = turned_inside_out(std::move(mesh));
      winds_once = false;
    }
    mesh.winds_once = winds_once;
    if (n % 7 == 0) mesh.local = MeshStructure::kd;
    const Mesh solid = prepared(std::move(mesh));
    for (int i = 0; i < 2000; ++i) {
      checks.check(solid, random_ray(random), 2, random);
      ASSERT_FALSE(HasFatalFailure()) << n;
    }
  }
  EXPECT_GT(checks.found, 40'000);
  EXPECT_GT(checks.from_faces, 20'000);
  EXPECT_LT(checks.unsure, checks.asked / 50);
}

// Parts that touch: two boxes with a common face, welded or not, a box whose face lies within a larger one's, both ways
// along the line.
TEST(MeshNext, IsUnsureWherePartsTouch) {
  TriangleMesh welded = meshes::box({0, 0, 0}, {1, 1, 1});
  for (const auto& [y, z] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}}) {
    welded.vertices.push_back({-1, y, z});
  }
  // The vertices of the box at x = 0 are 0, 2, 4 and 6.
  for (const auto& corners : meshes::box({-1, 0, 0}, {0, 1, 1}).triangles) {
    const auto vertex = [](std::uint32_t v) { return v % 2 == 1 ? v - 1 : 8 + v / 2; };
    welded.triangles.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
  }
  TriangleMesh apart = meshes::together(meshes::box({0, 0, 0}, {1, 1, 1}), meshes::box({-1, 0.2, 0.2}, {0, 0.7, 0.7}));
  apart.winds_once = true;
  for (TriangleMesh& mesh : std::array{welded, apart}) {
    const Mesh solid = prepared(std::move(mesh));
    for (const double side : {1.0, -1.0}) {
      for (const double y : {0.3, 0.4, 0.6}) {
        LocalRay ray;
        ray.origin = {-3 * side, y, 0.55};
        ray.direction = {side, 0.01, 0};
        const CrossingSearch outside{0, 0, 1e-9}, within{0, 2 + 1e-6, 1e-9};
        EXPECT_EQ(solid.next_crossing(ray, outside).kind, NextCrossing::Kind::found);
        EXPECT_EQ(solid.next_crossing(ray, within).kind, NextCrossing::Kind::unsure) << y;
      }
    }
  }
}

// What cannot be told apart may be larger than the place from which the mesh's windings are known.
TEST(MeshNext, SeesWhatIsNearTheStart) {
  Random random(13);
  const Mesh solid = prepared(meshes::star(4, [](const Vec3&) { return 1.0; }));
  for (int i = 0; i < 1000; ++i) {
    LocalRay ray;
    ray.direction = -random.direction();
    ray.origin = -2 * ray.direction;
    Spans whole;
    solid.spans(ray, whole);
    ASSERT_FALSE(whole.empty());
    const double distance = random.magnitude(-2, -0.3);
    ray.origin = ray.origin + (whole.front().t - distance) * ray.direction;
    const double near = 2.5 * distance;
    EXPECT_EQ(solid.next_crossing(ray, {0, 0.5 * near, near}).kind, NextCrossing::Kind::unsure);
  }
}

TEST(MeshNext, KnowsACrossingByItsNeighbourhood) {
  Random random(12);
  outlines::NearbyCrossings checks;
  for (int n = 0; n < 20; ++n) {
    const Mesh solid = prepared(rough_ball(1 + n % 4, 1, random));
    for (int i = 0; i < 2000; ++i) {
      const LocalRay ray = random_ray(random);
      checks.check(solid, ray, random);
      checks.check_from_start(solid, ray, random);
    }
  }
  EXPECT_GT(checks.asked, 50'000);
  EXPECT_GT(checks.found, 0.7 * checks.asked);
}

TEST(MeshNext, KnowsNoCrossingFurtherOffThanIsAsked) {
  const Mesh solid = prepared(meshes::box({0, 0, 0}, {1, 1, 1}));
  LocalRay ray;
  ray.origin = {-1, 0.3, 0.4};
  ray.direction = {1, 0.02, 0.01};
  for (const double off : {-1.5, -1.1, -0.9, 0.0, 0.9, 1.1, 1.5}) {
    const auto found = solid.crossing_near(ray, 1 + 1e-6 * off, 1e-6, true);
    EXPECT_EQ(found.has_value(), std::fabs(off) < 1) << off;
    EXPECT_FALSE(solid.crossing_near(ray, 1 + 1e-6 * off, 1e-6, false)) << off;
  }
}

}  // namespace
}  // namespace tenon
