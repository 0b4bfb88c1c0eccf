#include "mesh/idle_parts.h"

#include <gtest/gtest.h>

#include <utility>

#include "mesh/build_mesh.h"
#include "support/meshes.h"

namespace tenon {
namespace {

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (auto& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  return mesh;
}

TEST(IdleParts, AMeshWindsOnceWhereNoPartLiesInAnotherOfItsKind) {
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 1, 1}), small = meshes::box({0.2, 0.3, 0.1}, {0.7, 0.8, 0.6});
  EXPECT_TRUE(find_idle_parts(box).winds_once);
  EXPECT_TRUE(find_idle_parts(meshes::together(box, meshes::box({2, 0, 0}, {3, 1, 1}))).winds_once);
  // A hollow, and a kernel within it.
  const TriangleMesh hollow = meshes::together(box, turned_inside_out(small));
  EXPECT_TRUE(find_idle_parts(hollow).winds_once);
  EXPECT_TRUE(find_idle_parts(meshes::together(hollow, meshes::box({0.3, 0.4, 0.2}, {0.5, 0.6, 0.4}))).winds_once);
  // A part that adds nothing, and a hollow in nothing.
  EXPECT_FALSE(find_idle_parts(meshes::together(box, small)).winds_once);
  const TriangleMesh beside = turned_inside_out(meshes::box({2, 0, 0}, {3, 1, 1}));
  EXPECT_FALSE(find_idle_parts(meshes::together(box, beside)).winds_once);
}

// Two tetrahedra along one edge, of which one faces inward: by edges they hang together.
TEST(IdleParts, EdgesOfFourTrianglesTellNothing) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, bool outward) {
    const TriangleMesh::Corners corners[] = {{a, c, b}, {a, b, d}, {b, c, d}, {c, a, d}};
    for (TriangleMesh::Corners triangle : corners) {
      if (!outward) std::swap(triangle[1], triangle[2]);
      mesh.triangles.push_back(triangle);
    }
  };
  add(0, 1, 2, 3, true);
  add(0, 1, 4, 5, false);
  EXPECT_EQ(find_idle_parts(mesh).part_count, 1u);
  EXPECT_FALSE(find_idle_parts(mesh).winds_once);
}

// What is read is known to wind once, but where it overlaps itself.
TEST(BuildMesh, TellsWhetherAMeshWindsOnce) {
  const auto is_known_to = [](const TriangleMesh& mesh) {
    PolygonSoup soup;
    soup.points = mesh.vertices;
    for (const auto& corners : mesh.triangles) {
      soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
      soup.ends.push_back(static_cast<std::uint32_t>(soup.corners.size()));
    }
    const auto built = build_mesh(soup, "the mesh", false);
    EXPECT_TRUE(built);
    return built && built->mesh.winds_once;
  };
  const TriangleMesh box = meshes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(is_known_to(box));
  EXPECT_TRUE(is_known_to(turned_inside_out(box)));
  EXPECT_TRUE(is_known_to(meshes::together(box, meshes::box({1, 0.2, 0.2}, {2, 0.7, 0.7}))));
  EXPECT_FALSE(is_known_to(meshes::together(box, meshes::box({0.5, 0.2, 0.2}, {2, 0.7, 0.7}))));
  EXPECT_FALSE(is_known_to(meshes::together(box, meshes::box({0.5, 0.2, 0.2}, {0.8, 0.7, 0.7}))));
}

}  // namespace
}  // namespace tenon
