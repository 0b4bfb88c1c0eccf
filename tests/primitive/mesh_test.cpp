#include <gtest/gtest.h>

#include "primitive/check_crossings.h"
#include "primitive/dispatch.h"
#include "primitive/edge_sign.h"
#include "primitive/mesh.h"
#include "primitive/mesh_crossings.h"
#include "primitive/mesh_edges.h"
#include "support/meshes.h"

// What is particular to meshes: lines through vertices, along edges and in faces, and what no rounding may decide.
namespace tenon {
namespace {

using exact::Line;
using exact::Quad;
using exact::Vec;

struct Solid {
  PrimitiveStore store;
  PrimitiveId id;
  oracle::Solid<Quad> definition;

  explicit Solid(TriangleMesh mesh, bool hull = false) : Solid(meshes::share(std::move(mesh)), hull) {}
  Solid(const SharedMesh& mesh, bool hull) : definition("mesh", {mesh, hull}) {
    const auto added = store.add(*PrimitiveStore::find_kind("mesh"), std::vector<FieldValue>{mesh, hull});
    EXPECT_TRUE(added);
    id = *added;
  }
  Spans cross(const Vec3& origin, const Vec3& direction) const {
    Spans out;
    spans(store, id, {origin, direction, {}, {}, -1}, out);
    return out;
  }
};

// Vertices on a lattice, so that lines through them are exact, aimed at vertices and at the middles of edges.
TEST(Mesh, LinesThroughVerticesAndEdgesAreExact) {
  Random random(5);
  for (int n = 0; n < 30; ++n) {
    TriangleMesh mesh = n % 2 == 0
                            ? meshes::box({0, 0, 0}, {2, 4, 8})
                            : meshes::star(1 + random.below(2), [&](const Vec3&) { return random.uniform(4, 9); });
    for (Vec3& v : mesh.vertices) v = {std::round(16 * v.x), std::round(16 * v.y), std::round(16 * v.z)};
    if (find_open_edges(mesh.triangles)) continue;
    const Solid solid(mesh);
    for (int i = 0; i < 1000; ++i) {
      const auto vertex = [&] {
        return mesh.vertices[static_cast<std::size_t>(random.below(static_cast<int>(mesh.vertices.size())))];
      };
      const auto [a, b, c] =
          mesh.corners(static_cast<std::size_t>(random.below(static_cast<int>(mesh.triangles.size()))));
      const Vec3 target = random.chance(0.5) ? vertex() : 0.5 * a + 0.5 * b;
      const Vec3 from = random.chance(0.5) ? vertex() : 200 * random.in_cube();
      Vec3 direction = random.chance(0.3) ? Vec3{0, 0, 0} : target - from;
      if (direction == Vec3{}) direction[random.below(3)] = random.sign();
      const Vec3 origin = target - direction;
      const Spans out = solid.cross(origin, direction);
      const auto problem = check_against(solid.definition, {Vec<Quad>(origin), Vec<Quad>(direction)}, out, 0,
                                         200 / length(direction), random, 4);
      ASSERT_FALSE(problem) << *problem << describe(origin, direction);
    }
  }
}

TEST(Mesh, ALineInAFaceCrossesAnEvenNumber) {
  const Solid solid(meshes::box({0, 0, 0}, {1, 1, 1}));
  for (const double y : {0.0, 0.25, 1.0}) {
    for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{1, 0.5, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}) {
      for (const double z : {0.0, 1.0}) {
        const Spans out = solid.cross({-1, y, z}, direction);
        EXPECT_FALSE(check_order(out)) << *check_order(out);
      }
    }
  }
}

TEST(Mesh, OverlappingPartsAreOneSolid) {
  const Solid solid(meshes::together(meshes::box({0, 0, 0}, {2, 2, 2}), meshes::box({1, 0.5, 0.5}, {3, 1.5, 1.5})));
  const Spans out = solid.cross({-1, 1.1, 0.9}, {1, 0, 0});
  ASSERT_EQ(out.size(), 2u) << describe(out);
  EXPECT_NEAR(out[0].t, 1, 1e-14);
  EXPECT_NEAR(out[1].t, 4, 1e-14);
  // A cavity: an inner box that faces the other way.
  TriangleMesh inner = meshes::box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  for (auto& corners : inner.triangles) std::swap(corners[1], corners[2]);
  EXPECT_EQ(Solid(meshes::together(meshes::box({0, 0, 0}, {2, 2, 2}), inner)).cross({-1, 1.1, 0.9}, {1, 0, 0}).size(),
            4u);
}

// A line in the top of a box that lies within another one from the same base, and through the middle of the other's
// faces: what is in doubt of the one says nothing of the other.
TEST(Mesh, ALineInAFaceOfAPartCrossesThePartAround) {
  TriangleMesh mesh = meshes::box({0, 0, 0}, {1, 1, 1});
  const TriangleMesh around = meshes::box({0, 0, 0}, {1, 1, 2});
  for (std::uint32_t v = 4; v < 8; ++v) mesh.vertices.push_back(around.vertices[v]);
  for (const auto& corners : around.triangles) {
    const auto welded = [](std::uint32_t v) { return v < 4 ? v : v + 4; };
    mesh.triangles.push_back({welded(corners[0]), welded(corners[1]), welded(corners[2])});
  }
  const Solid solid(std::move(mesh));
  for (const double y : {0.25, 0.5, 0.75}) {
    const Spans out = solid.cross({-5, y, 1}, {1, 0, 0});
    ASSERT_GE(out.size(), 2u) << y;
    EXPECT_NEAR(out.front().t, 5, 1e-9) << y;
    EXPECT_LE(out.front().bound, 1e-9) << y;
    EXPECT_NEAR(out.back().t, 6, 1e-9) << y;
    EXPECT_LE(out.back().bound, 1e-9) << y;
  }
}

TEST(Mesh, AHullIsASurface) {
  TriangleMesh open = meshes::box({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  PrimitiveStore store;
  const auto refused =
      store.add(*PrimitiveStore::find_kind("mesh"), std::vector<FieldValue>{meshes::share(open), false});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("3 of its edges"), std::string::npos) << refused.error().message;
  const Solid hull(open, true);
  const Spans out = hull.cross({0.3, 0.2, -1}, {0, 0, 1});
  ASSERT_EQ(out.size(), 2u) << describe(out);
  for (const Crossing& c : out) EXPECT_TRUE(c.surface);
  // Through the hole.
  EXPECT_EQ(hull.cross({0.3, 0.6, -1}, {0, 0, 1}).size(), 1u);
}

// The structure within decides nothing: the same crossings to the last bit, whatever the ray grazes, and from so far
// away that the kd-tree cannot follow the line.
TEST(Mesh, TheKdTreeFindsWhatTheHierarchyFinds) {
  Random random(6);
  for (int n = 0; n < 20; ++n) {
    TriangleMesh mesh = n % 2 == 0 ? meshes::ring(1, 0.4, 24, 12)
                                   : meshes::star(3, [&](const Vec3&) { return random.uniform(0.5, 1); });
    for (Vec3& v : mesh.vertices)
      v = 0x1p-8 * Vec3{std::round(256 * v.x), std::round(256 * v.y), std::round(256 * v.z)};
    if (find_open_edges(mesh.triangles)) continue;
    const Solid bvh(mesh);
    mesh.local = MeshStructure::kd;
    const Solid kd(mesh);
    for (int i = 0; i < 2000; ++i) {
      const auto [a, b, c] =
          mesh.corners(static_cast<std::size_t>(random.below(static_cast<int>(mesh.triangles.size()))));
      const Vec3 target = i % 3 == 0 ? a : i % 3 == 1 ? 0.5 * a + 0.5 * b : 0.3 * a + 0.3 * b + 0.4 * c;
      Vec3 direction = random.direction();
      for (int axis = 0; axis < 3; ++axis) {
        if (random.chance(0.2)) direction[axis] = 0;
      }
      if (direction == Vec3{}) direction.x = 1;
      const double away = i % 20 == 0 ? random.magnitude(4, 14) : random.uniform(-3, 3);
      LocalRay ray{target - away * direction, direction, {}, {}, -1};
      ray.origin_error = std::fabs(away) * Vec3{0x1p-50, 0x1p-50, 0x1p-50};
      Spans from_bvh, from_kd;
      spans(bvh.store, bvh.id, ray, from_bvh);
      spans(kd.store, kd.id, ray, from_kd);
      ASSERT_EQ(from_bvh.size(), from_kd.size()) << describe(ray.origin, direction);
      for (std::size_t k = 0; k < from_bvh.size(); ++k) {
        EXPECT_EQ(from_bvh[k].t, from_kd[k].t);
        EXPECT_EQ(from_bvh[k].bound, from_kd[k].bound);
        EXPECT_EQ(from_bvh[k].face, from_kd[k].face);
      }
    }
  }
}

// Meshes whose vertices lie on a lattice, one of which overlaps itself, one far from the origin of its frame, one flat.
std::vector<TriangleMesh> lattice_meshes(Random& random) {
  std::vector<TriangleMesh> meshes{
      meshes::ring(1, 0.4, 24, 12), meshes::star(3, [&](const Vec3&) { return random.uniform(0.5, 1); }),
      meshes::together(meshes::star(3, [](const Vec3&) { return 1.0; }), meshes::ring(1, 0.5, 16, 8)),
      meshes::star(3, [](const Vec3&) { return 1.0; }), meshes::ring(1, 0.25, 16, 8)};
  for (Vec3& v : meshes[3].vertices) v += Vec3{0x1p16, -0x1p18, 0};
  for (Vec3& v : meshes[4].vertices) v.z *= 0x1p-6;
  for (TriangleMesh& mesh : meshes) {
    for (Vec3& v : mesh.vertices) {
      v = 0x1p-12 * Vec3{std::round(0x1p12 * v.x), std::round(0x1p12 * v.y), std::round(0x1p12 * v.z)};
    }
  }
  std::erase_if(meshes, [](const TriangleMesh& mesh) { return find_open_edges(mesh.triangles).has_value(); });
  return meshes;
}

// Through a vertex, the middle of an edge or the inside of a triangle, some along an axis or two.
LocalRay ray_at_triangle(const TriangleMesh& mesh, Random& random) {
  const auto [a, b, c] = mesh.corners(static_cast<std::size_t>(random.below(static_cast<int>(mesh.triangles.size()))));
  const int what = random.below(3);
  const Vec3 target = what == 0 ? a : what == 1 ? 0.5 * a + 0.5 * b : 0.3 * a + 0.3 * b + 0.4 * c;
  Vec3 direction = random.magnitude(-3, 3) * random.direction();
  for (int axis = 0; axis < 3; ++axis) {
    if (random.chance(0.2)) direction[axis] = 0;
  }
  if (direction == Vec3{}) direction.x = 1;
  LocalRay ray;
  ray.origin = target - random.uniform(-2, 2) / length(direction) * direction;
  ray.direction = direction;
  return ray;
}

Box3 bounds_of(const TriangleMesh& mesh) {
  Box3 bounds;
  for (const Vec3& v : mesh.vertices) bounds = hull(bounds, v);
  return bounds;
}

// Single precision only leaves out what the line misses, whatever is known of the line.
TEST(Mesh, TheHierarchyFindsEveryTriangleThatALineMayCross) {
  Random random(7);
  std::size_t found = 0, visited = 0;
  for (const TriangleMesh& mesh : lattice_meshes(random)) {
    const MeshBvh bvh(mesh);
    const Box3 bounds = bounds_of(mesh);
    for (int i = 0; i < 1000; ++i) {
      LocalRay ray = ray_at_triangle(mesh, random);
      const double error = i % 4 == 0 ? random.magnitude(-16, 1) : 0;
      ray.origin_error = error * random.in_cube();
      ray.origin_error = max(ray.origin_error, -ray.origin_error);
      if (i % 16 == 0) ray.direction_error = random.magnitude(-16, -3) * length(ray.direction) * Vec3{1, 1, 1};
      if (i % 10 == 0) ray.origin = ray.origin - random.magnitude(1, 14) / length(ray.direction) * ray.direction;
      const MeshLine line(ray, bounds);
      MeshCandidate candidate;
      std::vector<bool> seen(mesh.triangles.size());
      bvh.walk(line, {}, [&](std::uint32_t t) {
        EXPECT_FALSE(seen[t]);
        seen[t] = true;
        ++visited;
      });
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!find_candidate(line, mesh, t, candidate)) continue;
        ++found;
        ASSERT_TRUE(seen[t]) << describe(ray.origin, ray.direction);
      }
    }
  }
  // And it does leave out nearly all others.
  EXPECT_LT(visited, 2 * found);
}

// What a line crosses before it starts is told by how often the mesh winds around the start.
TEST(Mesh, CrossingsFromAStartOnAreThoseOfTheWholeLine) {
  Random random(8);
  int shortened = 0;
  for (const TriangleMesh& mesh : lattice_meshes(random)) {
    for (const MeshStructure local : {MeshStructure::bvh, MeshStructure::kd}) {
      TriangleMesh copy = mesh;
      copy.local = local;
      Mesh solid;
      solid.mesh = meshes::share(std::move(copy));
      solid.prepare();
      for (int i = 0; i < 2000; ++i) {
        const LocalRay ray = ray_at_triangle(mesh, random);
        const double begin = random.uniform(-1, 4) / length(ray.direction);
        Spans whole, some;
        solid.spans(ray, whole);
        solid.spans_within(ray, {begin, Box3::inf}, some);
        const auto is_near = [begin](const Crossing& c) { return std::fabs(c.t - begin) <= c.bound; };
        if (std::any_of(whole.begin(), whole.end(), is_near)) continue;
        ASSERT_FALSE(check_order(some)) << *check_order(some) << describe(some);
        shortened += some.size() < whole.size() || (!some.empty() && some.front().t == -Box3::inf);
        bool inside = false;
        for (const Crossing& c : some) inside ^= c.t < begin;
        for (const Crossing& c : whole) inside ^= c.t < begin;
        ASSERT_FALSE(inside) << describe(whole) << describe(some);
        std::erase_if(whole, [begin](const Crossing& c) { return c.t < begin; });
        std::erase_if(some, [begin](const Crossing& c) { return c.t < begin; });
        ASSERT_EQ(whole.size(), some.size()) << describe(ray.origin, ray.direction);
        for (std::size_t k = 0; k < whole.size(); ++k) {
          EXPECT_LE(std::fabs(whole[k].t - some[k].t), whole[k].bound);
          EXPECT_EQ(whole[k].entering, some[k].entering);
        }
      }
    }
  }
  EXPECT_GT(shortened, 5000);
}

// A kd-tree meets a triangle in several leaves, and each turns the winding number of what lies behind it once.
TEST(Mesh, FromAStartOnTheKdTreeFindsWhatTheHierarchyFinds) {
  Random random(9);
  Mesh by_boxes, by_planes;
  TriangleMesh mesh = meshes::star(5, [&](const Vec3&) { return random.uniform(0.8, 1); });
  by_boxes.mesh = meshes::share(mesh);
  mesh.local = MeshStructure::kd;
  by_planes.mesh = meshes::share(std::move(mesh));
  by_boxes.prepare();
  by_planes.prepare();
  int crossed = 0;
  for (int i = 0; i < 20'000; ++i) {
    LocalRay ray;
    ray.origin = 1.1 * random.in_cube();
    ray.direction = random.direction();
    Spans expected, found;
    by_boxes.spans_within(ray, {0, Box3::inf}, expected);
    by_planes.spans_within(ray, {0, Box3::inf}, found);
    ASSERT_EQ(expected.size(), found.size()) << describe(ray.origin, ray.direction);
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(expected[k].t, found[k].t);
    crossed += static_cast<int>(found.size());
  }
  EXPECT_GT(crossed, 10'000);
}

TEST(EdgeSign, IsExactAndOfOppositeSignBackwards) {
  Random random(2);
  int ties = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto small = [&] { return Vec3{1.0 * random.below(5), 1.0 * random.below(5), 1.0 * random.below(5)}; };
    // Far away, where double rounds everything but the lattice itself.
    const Vec3 offset = i % 2 == 0 ? Vec3{} : Vec3{0x1p40, -0x1p41, 0x1p39};
    const Vec3 o = small() + offset, a = small() + offset, b = small() + offset;
    Vec3 d = small();
    if (d == Vec3{}) d.x = 1;
    const int sign = edge_sign(o, d, a, b);
    EXPECT_EQ(edge_sign(o, d, b, a), -sign);
    const double value = dot(d, cross(a - o, b - o));
    if (value != 0) {
      EXPECT_EQ(sign, value > 0 ? 1 : -1);
    } else {
      ++ties;
      EXPECT_EQ(sign == 0, cross(a - b, d) == Vec3{});
    }
  }
  EXPECT_GT(ties, 1000);
}

}  // namespace
}  // namespace tenon
