#include <gtest/gtest.h>

#include "primitive/mesh.h"
#include "primitive/random_placement.h"
#include "support/meshes.h"

namespace tenon {
namespace {

// One mesh of two.
TriangleMesh joined(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (TriangleMesh::Corners corners : b.triangles) {
    for (std::uint32_t& v : corners) v += first;
    a.triangles.push_back(corners);
  }
  return a;
}

TriangleMesh random_mesh(Random& random) {
  switch (random.below(4)) {
    case 0:
      return meshes::star(random.below(2), [&](const Vec3&) { return random.uniform(0.4, 1); });
    case 1:
      return meshes::ring(1, 0.4, 3 + random.below(4), 3 + random.below(3));
    case 2:
      return meshes::box({-1, -1, -1}, {1, 1, 1});
    default:
      // Beside one another, or overlapping.
      return joined(meshes::box({-1, -1, -1}, {0.2, 1, 1}),
                    meshes::box({random.uniform(-0.5, 0.8), -0.5, -0.5}, {1.2, 0.5, 0.5}));
  }
}

// Two parts that overlap, and whose ends lie in one plane: between the planes of one the mesh winds twice, and once
// beyond.
TEST(MeshPlanes, ArePartsOfTheUnionAlone) {
  Mesh solid;
  solid.mesh = meshes::share(joined(meshes::box({0, -1, -1}, {1, 1, 1}), meshes::box({0, -1, -1}, {5, 1, 1})));
  solid.prepare();
  const Vec3 low{-3, -0.5, -0.5}, high{1.5, 0.5, 0.5};
  const auto placement = Placement::create(BoundedAffine3::elementary(Affine3::rotate({0, 0, 0})), {0, 0, 0});
  std::vector<Plane> planes;
  EXPECT_EQ(solid.planes_within(placement->to_local(Box3{low, high}), planes), PlanarPart::unknown);
}

// Where a mesh is said to be what lies below some planes, or all but that, it is.
TEST(MeshPlanes, HoldTheMeshWithinTheirBox) {
  Random random(95);
  int pieces = 0, corners = 0, notches = 0, points = 0, inside = 0;
  for (int round = 0; round < 20000; ++round) {
    Mesh solid;
    TriangleMesh mesh = random_mesh(random);
    mesh.local = random.chance(0.3) ? MeshStructure::kd : MeshStructure::bvh;
    solid.mesh = meshes::share(std::move(mesh));
    solid.prepare();
    const Affine3 map = random.chance(0.5) ? Affine3::rotate({0, 0, 0}) : Affine3::rotate(90 * random.in_cube());
    const auto placement = Placement::create(BoundedAffine3::elementary(map), {0, 0, 0});
    ASSERT_TRUE(placement);
    // Around a place on a triangle, an edge or a corner.
    const auto triangle = static_cast<std::size_t>(random.below(static_cast<int>(solid.mesh->triangles.size())));
    const auto [a, b, c] = solid.mesh->corners(triangle);
    const double v = random.chance(0.4) ? 0 : random.uniform(0, 0.5),
                 w = random.chance(0.4) ? 0 : random.uniform(0, 0.5);
    const Vec3 middle = map.point(a + v * (b - a) + w * (c - a));
    const Vec3 half = random.magnitude(-4, -0.3) * Vec3{1, random.uniform(0.3, 1), 1};
    const Box3 box{middle - half, middle + half};
    std::vector<Plane> planes;
    const PlanarPart part = solid.planes_within(placement->to_local(box), planes);
    if (part == PlanarPart::unknown) continue;
    ++pieces;
    corners += planes.size() > 1;
    notches += part == PlanarPart::above_any && planes.size() > 1;
    for (const Plane& plane : planes) EXPECT_NEAR(length(plane.normal), 1, 1e-12);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = placement->point_to_local(middle + half * random.in_cube());
      double beyond = -HUGE_VAL;
      for (const Plane& plane : planes) beyond = std::max(beyond, dot(plane.normal, p) - plane.d);
      const Region region = solid.classify({p, {}, {}, {p, p}});
      if (std::fabs(beyond) < 1e-9 || region == Region::straddles) continue;
      ++points;
      inside += region == Region::inside;
      ASSERT_EQ((beyond < 0) == (part == PlanarPart::below_all), region == Region::inside) << "round " << round;
    }
  }
  EXPECT_GT(pieces, 6000);
  EXPECT_GT(corners, 1500);
  EXPECT_GT(notches, 100);
  EXPECT_GT(inside, points / 5);
  EXPECT_LT(inside, 4 * points / 5);
}

}  // namespace
}  // namespace tenon
