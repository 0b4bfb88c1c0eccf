#include <utility>
#include <vector>

#include "accel/cells_checks.h"
#include "support/instruction_sets.h"
#include "support/meshes.h"

namespace tenon {
namespace {

using fixtures::Draw;
using fixtures::SceneBuilder;
using namespace cells_checks;

// Rough balls and a ring, bored by one another and by others, hollow, within one another, in both structures.
CsgTree dense_meshes(int round, Draw& draw) {
  SceneBuilder b;
  const auto mesh = [&](TriangleMesh triangles, bool winds_once = true) {
    triangles.local = round % 3 == 2 ? MeshStructure::kd : MeshStructure::bvh;
    triangles.winds_once = winds_once && round % 2 == 0;
    return b.primitive("mesh", {meshes::share(std::move(triangles)), false});
  };
  const auto rough = [&](int levels, double size) {
    return meshes::star(levels, [&](const Vec3&) { return size * draw.real(0.85, 1); });
  };
  const auto hollow = [&](double size) {
    TriangleMesh inner = rough(2, 0.7 * size);
    for (auto& corners : inner.triangles) std::swap(corners[1], corners[2]);
    return mesh(meshes::together(rough(4, size), inner));
  };
  const SceneNodeId within = mesh(meshes::together(rough(3, 0.8), rough(2, 0.4)), false);
  const SceneNodeId ring = mesh(meshes::ring(1.5, 0.4, 40, 20));
  const SceneNodeId bodies = b.unite({hollow(1), b.translate({1.2, 0.3, 0}, within), b.rotate({40, 20, 0}, ring),
                                      b.translate({0, 1, 0.5}, b.cube({1, 1, 1}))});
  const SceneNodeId tools =
      b.unite({b.translate({0.2, 0.1, -2}, b.cylinder(4, 0.3)), b.translate({0.5, -0.8, 0.3}, mesh(rough(3, 0.6))),
               b.translate({1, 0.5, 0.7}, b.sphere(0.5)), b.translate({-2, -2, -2}, b.cube({2, 2, 2}))});
  if (round % 4 == 3) return b.tree(b.intersect({bodies, b.rotate({0, 0, 30}, mesh(rough(4, 1.6))), b.sphere(1.4)}));
  return b.tree(b.subtract({bodies, tools}));
}

// Of meshes of many triangles rays are told one crossing after another, among what has a record, and no sooner than it
// matters.
TEST(Cells, FollowDenseMeshesFromCrossingToCrossing) {
  Draw draw(61);
  for (int round = 0; round < 10; ++round) {
    SCOPED_TRACE(round);
    const CsgTree tree = dense_meshes(round, draw);
    for (const char* spec : {"cells", "cells:quality=fast"}) expect_same_answers(tree, spec, 400);
    expect_streams_say_what_single_rays_say(tree, 4000);
  }
}

// Balls that stand before one another, and apart: a block of rays meets several of them, each by itself.
CsgTree balls_in_a_row(Draw& draw) {
  SceneBuilder b;
  std::vector<SceneNodeId> balls;
  for (int i = 0; i < 3; ++i) {
    TriangleMesh rough = meshes::star(3, [&](const Vec3&) { return draw.real(0.85, 1); });
    rough.winds_once = true;
    balls.push_back(b.translate({1.9 * i, 0.4 * i, 0}, b.primitive("mesh", {meshes::share(std::move(rough)), false})));
  }
  return b.tree(b.unite(balls));
}

// A picture of a tree, and the shadow rays from what it shows to two lights, in blocks as they are rendered.
std::vector<RayQuery> rays_of_a_picture(const CsgTree& tree, const Accelerator& none, Draw& draw,
                                        std::vector<Hit>& starts) {
  constexpr int size = 48, block = 8;
  const Box3 box = battery::extent(tree);
  const double radius = length(box.size());
  const Vec3 eye = box.center() + draw.real(0.6, 3) * radius * draw.direction();
  // Of a part of it, so that there are fewer triangles than rays, or of all.
  const Vec3 middle = draw.in_box(box), size_there = draw.real(0.03, 1) * box.size();
  std::vector<RayQuery> queries;
  for (int i = 0; i < size * size; ++i) {
    const int in_block = i % (block * block), blocks = i / (block * block);
    const int x = blocks % (size / block) * block + in_block % block;
    const int y = blocks / (size / block) * block + in_block / block;
    RayQuery query;
    const Vec3 at = middle + size_there * Vec3{(x + 0.5) / size - 0.5, (y + 0.5) / size - 0.5, 0};
    query.ray = {eye, draw.real(0.5, 2) * (at - eye)};
    query.kind = RayKind::primary;
    queries.push_back(query);
  }
  const auto context = none.make_context();
  starts.clear();
  for (const RayQuery& query : queries) {
    if (const Hit hit = none.first_hit(query, *context); hit.found()) starts.push_back(hit);
  }
  for (int light = 0; light < 2; ++light) {
    const Vec3 at = box.center() + draw.real(0.7, 4) * radius * draw.direction();
    for (const Hit& start : starts) queries.push_back(shadow_ray(start, at));
  }
  return queries;
}

// Rays of a block meet a mesh together, whatever stands around it, with any instructions.
TEST(Cells, BlocksMeetDenseMeshesAsSingleRaysDo) {
  for_each_instruction_set([&] {
    Draw draw(65);
    std::size_t found = 0;
    for (int round = 0; round < 12; ++round) {
      SCOPED_TRACE(round);
      const CsgTree tree = round % 2 == 1 ? balls_in_a_row(draw) : dense_meshes(round, draw);
      const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
      const auto context = (*none)->make_context(), other = (*judged)->make_context();
      std::vector<Hit> starts;
      const std::vector<RayQuery> queries = rays_of_a_picture(tree, **none, draw, starts);
      const auto [hits, boundaries, occluded] = ask_together(**judged, queries, *other);
      for (std::size_t i = 0; i < queries.size(); ++i) {
        const Hit hit = (*none)->first_hit(queries[i], *context);
        ASSERT_TRUE(battery::same_hit(hit, hits[i]))
            << battery::describe(hit) << " against " << battery::describe(hits[i]);
        ASSERT_EQ(occluded[i] != 0, hit.found()) << battery::describe(queries[i]);
        ASSERT_EQ(boundaries[i].t, hit.t) << battery::describe(queries[i]);
        ASSERT_EQ(boundaries[i].entering, hit.found() && hit.entering);
        if (!hit.found()) continue;
        ASSERT_EQ(boundaries[i].surface, hit.surface);
        ++found;
      }
    }
    EXPECT_GT(found, 10'000U);
  });
}

// Beside one of two meshes that intersect, nobody asks for the other.
TEST(Cells, AskMeshesWhenTheyMatter) {
  SceneBuilder b;
  const auto ball = [&](const Vec3& place) {
    TriangleMesh mesh = meshes::star(4, [](const Vec3&) { return 1.0; });
    mesh.winds_once = true;
    return b.translate(place, b.primitive("mesh", {meshes::share(std::move(mesh)), false}));
  };
  const CsgTree tree = b.tree(b.intersect({ball({0, 0, 0}), ball({0.02, 0.01, 0.03})}));
  const auto cells = build_accelerator("cells:depth=1", tree);
  ASSERT_TRUE(cells.ok());
  const auto context = (*cells)->make_context();
  const TraversalCounters& counters = context->statistics[RayKind::primary];
  Draw draw(64);
  for (int i = 0; i < 100; ++i) {
    const double x = draw.real(0.8, 0.9) * (i % 2 == 0 ? 1 : -1), y = draw.real(0.8, 0.9) * (i % 4 < 2 ? 1 : -1);
    EXPECT_FALSE((*cells)->first_hit({{{x, y, 5}, {0, 0, -1}}}, *context).found());
  }
  EXPECT_GE(counters.cells_visited, 100u);
  EXPECT_EQ(counters.primitive_tests, counters.cells_visited);
}

// The same mesh twice with faces in common, and beside a box with which it shares some.
TEST(Cells, FollowMeshesWhoseFacesCoincide) {
  Draw draw(62);
  for (int round = 0; round < 6; ++round) {
    SCOPED_TRACE(round);
    SceneBuilder b;
    TriangleMesh wavy = meshes::star(3, [&](const Vec3& v) { return v.z > 0.3 ? 0.9 / v.z : draw.real(0.8, 1); });
    wavy.winds_once = round % 2 == 0;
    const auto solid = [&] { return b.primitive("mesh", {meshes::share(wavy), false}); };
    const Vec3 turn = round % 3 == 0 ? Vec3{0, 0, 0} : Vec3{0, 0, draw.real(0, 90)};
    const SceneNodeId flush = b.translate({-0.5, -0.5, 0.4}, b.cube({1, 1, 0.5}));
    const SceneNodeId both = round < 3 ? b.unite({solid(), b.rotate(turn, solid()), flush})
                                       : b.subtract({b.unite({solid(), flush}), b.translate({0.3, 0, 0}, solid())});
    const CsgTree tree = b.tree(both);
    expect_same_answers(tree, "cells", 300, 0.05);
    expect_streams_say_what_single_rays_say(tree, 3000);
  }
}

// A part with dense meshes, stored once, in several places.
TEST(CellsInstances, OfMeshes) {
  Draw draw(63);
  for (int round = 0; round < 3; ++round) {
    SCOPED_TRACE(round);
    SceneBuilder b;
    TriangleMesh rough = meshes::star(4, [&](const Vec3&) { return draw.real(0.8, 1); });
    rough.winds_once = round > 0;
    const SceneNodeId ball = b.primitive("mesh", {meshes::share(std::move(rough)), false});
    const SceneNodeId part = b.subtract({b.unite({ball, b.translate({0.5, 0, 0}, b.rotate({30, 0, 50}, ball))}),
                                         b.translate({0, 0, -2}, b.cylinder(4, 0.3)), b.cube({2, 2, 2})});
    std::vector<SceneNodeId> parts;
    for (int i = 0; i < 9; ++i) {
      const Vec3 place{(round == 2 ? 1.3 : 3.5) * (i % 3), 3.5 * (i / 3), 0};
      parts.push_back(b.translate(place, b.rotate({0, 10.0 * i, 40.0 * i}, part)));
    }
    const CsgTree tree = b.instanced_tree(b.unite(parts));
    ASSERT_FALSE(tree.prototypes.empty());
    expect_same_answers(tree, "cells", 200, 0.05);
    expect_streams_say_what_single_rays_say(tree, 4000);
  }
}

}  // namespace
}  // namespace tenon
