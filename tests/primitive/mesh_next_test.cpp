#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

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

// Rays that go much the same way: from one place, or towards one, or side by side; some of another length, some another
// way, some that start on a face.
std::vector<LocalRay> random_bundle(const Mesh& solid, Random& random) {
  const LocalRay middle = random_ray(random);
  const double spread = random.magnitude(-4, -0.5);
  const bool fans_out = random.chance(0.6), moves = !fans_out || random.chance(0.3);
  std::vector<LocalRay> rays;
  const int count = 1 + random.below(static_cast<int>(most_packet_rays));
  for (int i = 0; i < count; ++i) {
    LocalRay ray = middle;
    if (moves) ray.origin += spread * random.in_cube();
    if (fans_out) ray.direction += spread * length(ray.direction) * random.in_cube();
    if (random.chance(0.1)) ray.direction = random.magnitude(-1, 1) * ray.direction;
    if (random.chance(0.02)) ray.direction = -ray.direction;
    if (random.chance(0.2)) {
      Spans whole;
      solid.spans(ray, whole);
      if (!whole.empty()) {
        const Crossing& start = whole.front();
        ray.origin += start.t * ray.direction;
        const double error = start.bound * max_component(abs(ray.direction)) + 1e-15;
        ray.origin_error = {error, error, error};
        ray.on_face = static_cast<int>(start.face);
      }
    }
    rays.push_back(ray);
  }
  return rays;
}

// A bundle as a packet, some rays of which are not asked.
struct RayRows {
  RayRows(const std::vector<LocalRay>& rays, Random& random) {
    packet.near = near.data();
    bool has_faces = false;
    for (std::size_t i = 0; i < most_packet_rays; ++i) {
      const LocalRay& ray = rays[std::min(i, rays.size() - 1)];
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        packet.origin[a][i] = ray.origin[axis];
        packet.direction[a][i] = ray.direction[axis];
        packet.origin_error[a][i] = ray.origin_error[axis];
        packet.direction_error[a][i] = ray.direction_error[axis];
      }
      const double length = tenon::length(ray.direction);
      packet.shift[i] = ray.on_face < 0 && random.chance(0.3) ? random.uniform(-1, 1) / length : 0;
      near[i] = random.magnitude(-12, -1) / length;
      on_face[i] = ray.on_face;
      has_faces |= ray.on_face >= 0;
      if (i < rays.size() && !random.chance(0.1)) packet.rays |= std::uint64_t{1} << i;
    }
    if (has_faces) packet.on_face = on_face.data();
  }

  LocalRayPacket packet;
  alignas(64) LocalRayPacket::Numbers near, on_face;
};

template <class Where>
void expect_same(const NextCrossing& a, const NextCrossing& b, const Where& where) {
  EXPECT_EQ(a.kind, b.kind) << where();
  if (a.kind != NextCrossing::Kind::found || b.kind != NextCrossing::Kind::found) return;
  EXPECT_EQ(a.crossing.t, b.crossing.t) << where();
  EXPECT_EQ(a.crossing.bound, b.crossing.bound) << where();
  EXPECT_EQ(a.crossing.face, b.crossing.face) << where();
  EXPECT_EQ(a.crossing.entering, b.crossing.entering) << where();
}

// Asked together, rays meet what each meets by itself, to the last bit.
TEST(MeshNext, TellsBundlesWhatItTellsEachRay) {
  Random random(14);
  int asked = 0, known = 0, found = 0, second_known = 0, from_faces = 0;
  for (int n = 0; n < 40; ++n) {
    TriangleMesh mesh = rough_ball(1 + n % 5, 1, random);
    if (n % 4 == 1) mesh = meshes::together(std::move(mesh), turned_inside_out(rough_ball(2, 0.7, random)));
    mesh.winds_once = n % 10 != 9;
    if (n % 10 == 8) mesh.local = MeshStructure::kd;
    const Mesh solid = prepared(std::move(mesh));
    ASSERT_EQ(solid.tells_packets(), n % 10 < 8);
    if (!solid.tells_packets()) continue;
    for (int i = 0; i < 100; ++i) {
      const std::vector<LocalRay> rays = random_bundle(solid, random);
      RayRows rows(rays, random);
      PacketCrossings together;
      together.wants_second = random.chance(0.5);
      solid.next_crossings(rows.packet, together);
      const auto& next = together.first;
      for (std::size_t k = 0; k < rays.size(); ++k) {
        if ((rows.packet.rays >> k & 1) == 0) {
          ASSERT_EQ(next[k].kind, NextCrossing::Kind::unsure);
          continue;
        }
        const double begin = -rows.packet.shift[k];
        const NextCrossing single = solid.next_crossing(rays[k], {begin, begin, rows.near[k]});
        ++asked;
        if (next[k].kind == NextCrossing::Kind::unsure) continue;
        ++known;
        from_faces += rays[k].on_face >= 0;
        const auto where = [&] { return describe(rays[k].origin, rays[k].direction); };
        expect_same(next[k], single, where);
        if (single.kind != NextCrossing::Kind::found) continue;
        ++found;
        const NextCrossing& second = together.second[k];
        if (second.kind == NextCrossing::Kind::unsure) continue;
        ++second_known;
        const double from = single.crossing.t + 0.5 * rows.near[k];
        expect_same(second, solid.next_crossing(rays[k], {begin, from, rows.near[k]}), where);
        ASSERT_FALSE(HasFailure());
      }
    }
  }
  EXPECT_GT(known, asked / 2);
  EXPECT_GT(found, asked / 4);
  EXPECT_GT(second_known, asked / 8);
  EXPECT_GT(from_faces, asked / 20);
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
