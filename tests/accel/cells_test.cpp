#include <numbers>

#include "accel/cells/cell_tree.h"
#include "accel/cells_checks.h"
#include "csg/expression.h"
#include "csg/minimum_enclosure.h"
#include "support/instruction_sets.h"

namespace tenon {
namespace {

using cells::CellTree;
using cells::Folder;
using cells::LocalExpression;
using cells::OwnerRanks;
using fixtures::Draw;
using fixtures::SceneBuilder;
using namespace cells_checks;

// Cells below, at and above what a word of truth values, a byte, and the classifier's limit have room for.
TEST(Cells, AreRightWithAnyNumberOfLeaves) {
  for (const int count : {5, 6, 7, 9, 10, 15, 63, 64, 100}) {
    SCOPED_TRACE(count);
    const CsgTree tree = tangent_spheres(count);
    for (const char* spec : {"cells", "cells:quality=fast", "cells:quality=high"}) expect_same_answers(tree, spec, 12);
    const auto accelerator = build_accelerator("cells", tree);
    EXPECT_GE(detail(**accelerator, "leaves in the fullest cell"), count / 2);
  }
}

// Walls so thin that the two faces are nearer to each other than the cells can tell.
TEST(Cells, LeaveThinWallsToTheExactStructure) {
  for (const double thickness : {1e-3, 1e-6, 1e-9}) {
    SCOPED_TRACE(thickness);
    SceneBuilder b;
    const CsgTree tree = b.tree(b.unite(
        {b.subtract({b.sphere(1), b.sphere(1 - thickness)}), b.rotate({10, 20, 30}, b.cube({3, 3, thickness}, true))}));
    expect_same_answers(tree, "cells");
  }
}

// A material given to one of several solids alone: the cut face of a tool without one shows the owner's.
TEST(Cells, KnowWhoOwnsACutFace) {
  SceneBuilder b;
  const SceneNodeId bodies = b.unite({b.material(1, b.sphere(1)), b.translate({0.5, 0, 0}, b.cube({2, 0.5, 0.5}, true)),
                                      b.material(0, b.translate({0, 0.7, 0}, b.sphere(0.8)))});
  const CsgTree tree = b.tree(b.subtract({bodies, b.translate({0, 0.3, 0.6}, b.sphere(0.7))}));
  expect_same_answers(tree, "cells", 200);
}

// Who owns a place matters only where another would show another material.
TEST(Cells, TellOwnersApartByTheirMaterials) {
  const auto owners_in_doubt = [](int other_material) {
    SceneBuilder b;
    const SceneNodeId bodies =
        b.unite({b.material(0, b.sphere(1)), b.material(0, b.translate({0.4, 0, 0}, b.sphere(1))),
                 b.material(other_material, b.translate({0, 0.4, 0}, b.sphere(1)))});
    const CsgTree tree = b.tree(b.subtract({bodies, b.translate({0.2, 0.2, 1}, b.sphere(0.5))}));
    expect_same_answers(tree, "cells", 100);
    return detail(**build_accelerator("cells", tree), "cells of several materials");
  };
  EXPECT_EQ(owners_in_doubt(0), 0);
  EXPECT_GT(owners_in_doubt(1), 0);
}

// Prisms come to a few planes or walls in most cells; where they do not, and where corners and flush faces meet,
// nothing differs.
TEST(Cells, FollowPrismsByWhatTheyComeTo) {
  Draw draw(39);
  for (int round = 0; round < 9; ++round) {
    SCOPED_TRACE(round);
    const bool is_tapered = round == 5 || round == 8, has_tangents = round == 6;
    SceneBuilder b;
    const auto star = [&](double size) {
      Outline outline{{{}, {}}};
      for (int i = 0; i < 14; ++i) {
        // On one circle arcs go on smoothly, as they do in what is rounded.
        const double r = size * (i % 2 == 0 || has_tangents ? 1 : draw.real(0.4, 0.9)), angle = 360.0 * i / 14;
        const double bulge = has_tangents ? std::tan(std::numbers::pi / 28) : round < 4 ? 0 : draw.real(-0.4, 1);
        outline.loops[0].push_back(
            {r * cos_degrees(angle), r * sin_degrees(angle), has_tangents || i % 3 == 0 ? bulge : 0});
      }
      for (int i = 0; i < 4; ++i) {
        outline.loops[1].push_back({0.2 * (i == 1 || i == 2), 0.3 * (i > 1), round >= 6 && i % 2 == 0 ? 1.0 : 0});
      }
      return b.primitive("prism", {outline, 1.0, round % 2 == 0, is_tapered ? 0.7 : 1.0});
    };
    const SceneNodeId plate =
        b.primitive("prism", {Outline{{{{-2, -1, 0}, {2, -1, 0}, {2, 1, 0}, {-2, 1, 0}}}}, 1.0, false, 1.0});
    const SceneNodeId bodies = b.unite({star(1.5), b.translate({0, 0, 0.5}, b.rotate({0, 0, 20}, star(1.2))),
                                        b.translate({2, 0, 0}, plate), b.rotate({70, 30, 0}, star(1))});
    const SceneNodeId tools =
        b.unite({b.translate({0.2, 0.1, -1}, b.cylinder(4, 0.3)), b.translate({2, -1, 0.5}, plate),
                 b.translate({1, 0.5, 0.7}, b.sphere(0.5)), b.rotate({0, 90, 0}, b.scale(0.5, star(1)))});
    const CsgTree tree = b.tree(b.subtract({bodies, tools}));
    for (const char* spec : {"cells", "cells:quality=fast"}) expect_same_answers(tree, spec, 400);
    expect_streams_say_what_single_rays_say(tree, 4000);
    const auto cells = build_accelerator("cells", tree);
    const double all = detail(**cells, "boundary cells");
    EXPECT_LT(detail(**cells, "cells with leaves of no special kind"), 0.5 * all);
  }
}

// Revolutions come to a few walls in most cells: cones, cylinders, planes across the axis, parts of balls and rings,
// from within and outside, and faces that lie in one another's.
TEST(Cells, FollowRevolutionsByTheirWalls) {
  Draw draw(43);
  for (int round = 0; round < 9; ++round) {
    SCOPED_TRACE(round);
    const bool has_arcs = round >= 3;
    SceneBuilder b;
    const auto turned = [&](double inner, double size) {
      std::vector<OutlineCorner> corners;
      const int count = 7 + round;
      for (int i = 0; i < count; ++i) {
        const double r = size * draw.real(0.5, 1), angle = 360.0 * i / count;
        corners.push_back({std::max(inner + size + r * cos_degrees(angle), 0.0), r * sin_degrees(angle), 0});
        // On a coarse lattice edges run along the axis and across it.
        OutlineCorner& corner = corners.back();
        if (round % 3 == 1) corner = {std::round(4 * corner.x) / 4, std::round(4 * corner.y) / 4, 0};
      }
      // Arcs bulge by half their chord at most, and may not reach over the axis.
      for (std::size_t i = 0; has_arcs && i < corners.size(); i += 2) {
        const OutlineCorner &from = corners[i], &to = corners[(i + 1) % corners.size()];
        const double reach = 0.5 * std::hypot(to.x - from.x, to.y - from.y);
        if (std::min(from.x, to.x) > reach) corners[i].bulge = draw.real(-0.5, 1);
      }
      return b.primitive("revolution", {Outline{{corners}}});
    };
    const SceneNodeId ring = b.primitive("revolution", {Outline{{{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}}}});
    const SceneNodeId bodies =
        b.unite({turned(0.3, 0.6), b.translate({0, 0, 0.5}, b.rotate({0, 0, 20}, turned(0, 0.7))),
                 b.translate({2, 0, 0}, ring), b.rotate({70, 30, 0}, turned(0.5, 0.4))});
    const SceneNodeId tools =
        b.unite({b.translate({0.2, 0.1, -1}, b.cylinder(4, 0.3)), b.translate({2, 0, 0.5}, ring),
                 b.translate({1, 0.5, 0.7}, b.sphere(0.5)), b.rotate({0, 90, 0}, b.scale(0.5, turned(0.2, 0.7)))});
    const CsgTree tree = b.tree(b.subtract({bodies, tools}));
    for (const char* spec : {"cells", "cells:quality=fast"}) expect_same_answers(tree, spec, 400);
    expect_streams_say_what_single_rays_say(tree, 4000);
    const auto cells = build_accelerator("cells", tree);
    EXPECT_LT(detail(**cells, "cells with leaves of no special kind"), 0.5 * detail(**cells, "boundary cells"));
  }
}

// Meshes of few triangles come to planes in most cells; with corners that go in and out, overlapping parts, and faces
// that lie in one another's.
TEST(Cells, FollowMeshesByTheirPlanes) {
  Draw draw(42);
  for (int round = 0; round < 8; ++round) {
    SCOPED_TRACE(round);
    SceneBuilder b;
    const auto mesh = [&](TriangleMesh triangles) {
      triangles.local = round % 2 == 0 ? MeshStructure::bvh : MeshStructure::kd;
      return b.primitive("mesh", {meshes::share(std::move(triangles)), false});
    };
    const auto block = [&](const Vec3& low, const Vec3& high) { return meshes::box(low, high); };
    // Two blocks in one mesh, which overlap in odd rounds.
    TriangleMesh two = block({-1, -1, -1}, {0.2, 1, 1});
    const TriangleMesh other = block({round % 2 == 0 ? 0.4 : -0.3, -0.5, -0.5}, {1.2, 0.5, 0.5});
    const auto first = static_cast<std::uint32_t>(two.vertices.size());
    two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (TriangleMesh::Corners corners : other.triangles) {
      for (std::uint32_t& v : corners) v += first;
      two.triangles.push_back(corners);
    }
    // A line that runs along a face of a mesh is known no better than the face is long, and the rays here run along
    // axes.
    const Vec3 turn{20, 35, 50.0 + round};
    const SceneNodeId bodies =
        b.unite({b.rotate(turn, mesh(two)), b.translate({0, 0, 1.2}, mesh(meshes::ring(1, 0.4, 5, 4))),
                 b.translate({1.2, 1, 0}, mesh(meshes::star(1, [&](const Vec3&) { return draw.real(0.5, 1); })))});
    const SceneNodeId tools =
        b.unite({b.rotate(turn, b.translate({-0.5, -0.5, 0}, mesh(block({0, 0, 0}, {1, 1, 1})))),
                 b.translate({0.5, 0, 1}, b.cylinder(2, 0.3)), b.translate({0, 1, 0}, b.sphere(0.4))});
    const CsgTree tree = b.tree(b.subtract({bodies, tools}));
    for (const char* spec : {"cells", "cells:quality=fast"}) expect_same_answers(tree, spec, 300);
    expect_streams_say_what_single_rays_say(tree, 3000);
    const auto cells = build_accelerator("cells", tree);
    EXPECT_LT(detail(**cells, "cells with leaves of no special kind"), 0.5 * detail(**cells, "boundary cells"));
  }
}

// So small that windows are no help, and alone, so that nothing but its planes gains by a cut.
TEST(Cells, CutAMeshOfFewTrianglesByItself) {
  SceneBuilder b;
  const TriangleMesh pebble = meshes::star(1, [](const Vec3& v) { return 1 + 0.3 * v.x; });
  const CsgTree tree = b.tree(b.rotate({20, 30, 0}, b.primitive("mesh", {meshes::share(pebble), false})));
  expect_same_answers(tree, "cells", 200);
  const auto cells = build_accelerator("cells", tree);
  const double all = detail(**cells, "boundary cells");
  EXPECT_GT(all, 10);
  EXPECT_LT(detail(**cells, "cells with leaves of no special kind"), 0.5 * all);
}

// Of some leaves a cell asks for a part of the ray's line alone, and they are cut where that pays.
TEST(Cells, AskLeavesForPartsOfTheLine) {
  Outline cross{{{}}};
  for (int i = 0; i < 12; ++i) {
    const double r = i % 3 == 0 ? 0.3 : 1, angle = 30.0 * i;
    cross.loops[0].push_back({r * cos_degrees(angle), r * sin_degrees(angle), i % 3 == 1 ? 0.25 : 0});
  }
  const Outline profile{{{{0.2, -1, 0}, {0.9, -0.8, 0.3}, {0.6, 0, -0.2}, {0.9, 0.9, 0}, {0.4, 1, 0}}}};
  const auto pebble = meshes::star(3, [](const Vec3& v) { return 1 + 0.2 * v.x * v.y; });
  const std::pair<const char*, std::vector<FieldValue>> leaves[] = {
      {"twisted_prism", {cross, 2.0, true, 300.0, 1.0, 0.7}},
      {"revolution", {profile}},
      {"prism", {cross, 2.0, true, 0.6}},
      {"mesh", {meshes::share(pebble), false}}};
  for (const auto& [kind, values] : leaves) {
    SCOPED_TRACE(kind);
    for (const bool is_cut : {false, true}) {
      SceneBuilder b;
      const SceneNodeId leaf = b.rotate({20, 30, 0}, b.primitive(kind, values));
      const SceneNodeId tool = b.translate({0.4, 0.2, 0.3}, b.sphere(0.7));
      const CsgTree tree = b.tree(is_cut ? b.subtract({leaf, tool}) : leaf);
      expect_same_answers(tree, "cells", 200);
      expect_streams_say_what_single_rays_say(tree, 2000);
      const double cells = detail(**build_accelerator("cells", tree), "boundary cells");
      if (std::string_view(kind) == "twisted_prism") {
        EXPECT_GT(cells, 20);
      }
    }
  }
}

// Rays to the tip of a cone graze it there; what they meet on the way is as certain as for their neighbours.
TEST(Cells, RaysToATipAreLikeTheirNeighbours) {
  SceneBuilder b;
  std::vector<SceneNodeId> parts{b.sphere(2), b.sphere(1.8)};
  for (const Vec3 turn : {Vec3{0, 0, 0}, Vec3{40, 0, 0}, Vec3{100, 20, 0}, Vec3{-70, 50, 10}, Vec3{160, 0, 0}}) {
    parts.push_back(b.rotate(turn, b.primitive("cone", {3.0, 0.0, 1.2, false})));
  }
  const CsgTree tree = b.tree(b.subtract(parts));
  const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
  const auto tests_of_rays = [&](double aside) {
    const auto context = (*none)->make_context(), other = (*judged)->make_context();
    Draw draw(38);
    std::vector<RayQuery> queries(2000);
    for (RayQuery& query : queries) {
      query.ray.origin = 4 * draw.direction();
      query.ray.direction = aside * draw.direction() - query.ray.origin;
      query.t_max = 0.9;
    }
    const auto [hits, boundaries, occluded] = ask_together(**judged, queries, *other);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Hit hit = (*none)->first_hit(queries[i], *context);
      EXPECT_TRUE(battery::same_hit(hit, hits[i]))
          << battery::describe(hit) << " against " << battery::describe(hits[i]);
      EXPECT_EQ(boundaries[i].t, hit.t);
      EXPECT_EQ(occluded[i] != 0, hit.found());
    }
    return static_cast<double>(other->statistics.total().primitive_tests);
  };
  EXPECT_LT(tests_of_rays(0), 1.1 * tests_of_rays(0.05));
}

// Rays that start on a solid of revolution are certain of where they meet it again, but along its side.
TEST(Cells, RaysFromTaperedSolidsAreLikeOthers) {
  SceneBuilder b;
  const SceneNodeId parts[] = {b.primitive("cone", {1.0, 0.8, 0.2, false}), b.primitive("cone", {1.0, 0.0, 0.7, true}),
                               b.primitive("hyperboloid", {1.0, 0.6, 0.3}), b.primitive("paraboloid", {1.0, 0.6})};
  std::vector<SceneNodeId> all;
  for (int i = 0; i < 4; ++i) {
    const double at = 2.0 * i;
    all.push_back(b.translate({at, 0, 0}, b.rotate({30.0 * i, 20, 0}, parts[i])));
    all.push_back(b.translate({at, 2, 0}, b.subtract({b.cube({1.2, 1.2, 1.2}, true), parts[i]})));
  }
  const CsgTree tree = b.tree(b.unite(all));
  const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
  const auto context = (*none)->make_context(), other = (*judged)->make_context(), lifted = (*judged)->make_context();
  Draw draw(39);
  const Box3 box = battery::extent(tree);
  int starts = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 at = draw.in_box(box), from = at + 10 * draw.direction();
    const Hit start = (*none)->first_hit({{from, at - from}}, *context);
    if (!start.found() || start.surface.face != 0) continue;
    ++starts;
    Vec3 direction = draw.direction();
    if (dot(direction, start.normal) < 0) direction = -direction;
    RayQuery query{{start.point, direction}};
    static_cast<void>((*judged)->first_hit({{start.point + 1e-4 * start.normal, direction}}, *lifted));
    query.from = &start;
    const Hit hit = (*none)->first_hit(query, *context), told = (*judged)->first_hit(query, *other);
    ASSERT_TRUE(battery::same_hit(hit, told)) << battery::describe(hit) << " against " << battery::describe(told);
  }
  EXPECT_GT(starts, 500);
  EXPECT_LT(static_cast<double>(other->statistics.total().primitive_tests),
            1.2 * static_cast<double>(lifted->statistics.total().primitive_tests));
}

TEST(Cells, FirstBoundariesAndOcclusionAreThoseOfFirstHits) {
  for (const gallery::Scene& scene : gallery::scenes) {
    SCOPED_TRACE(scene.name);
    const CsgTree tree = scene.build();
    const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
    const battery::RaySet rays = battery::make_rays(tree, **none, 20, 32);
    const auto context = (*none)->make_context(), other = (*judged)->make_context();
    std::vector<RayBoundary> boundaries(rays.queries.size());
    (*judged)->first_boundaries(rays.queries, boundaries, *other);
    for (std::size_t i = 0; i < rays.queries.size(); ++i) {
      const Hit hit = (*none)->first_hit(rays.queries[i], *context);
      ASSERT_EQ(boundaries[i].found(), hit.found()) << battery::describe(rays.queries[i]);
      ASSERT_EQ((*judged)->occluded(rays.queries[i], *other), hit.found()) << battery::describe(rays.queries[i]);
      if (!hit.found()) continue;
      EXPECT_EQ(boundaries[i].t, hit.t);
      EXPECT_EQ(boundaries[i].surface, hit.surface);
      EXPECT_EQ(boundaries[i].entering, hit.entering);
    }
  }
}

// Rays of one picture, which are traced many at a time.
TEST(Cells, PacketsSayWhatSingleRaysSay) {
  const CsgTree tree = gallery::random_scene(5, 24, 1.5);
  const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
  const auto context = (*none)->make_context(), other = (*judged)->make_context();
  const Box3 box = battery::extent(tree);
  std::vector<RayQuery> queries;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      RayQuery query;
      query.ray.origin = box.center() + Vec3{2, 3, 4} * length(box.size());
      const Vec3 at = box.lower + box.size() * Vec3{(x + 0.5) / 64, (y + 0.5) / 64, 0.4};
      query.ray.direction = at - query.ray.origin;
      queries.push_back(query);
    }
  }
  std::vector<Hit> hits(queries.size());
  (*judged)->first_hits(queries, hits, *other);
  std::size_t found = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Hit hit = (*none)->first_hit(queries[i], *context);
    found += hit.found();
    ASSERT_TRUE(battery::same_hit(hit, hits[i])) << battery::describe(hit) << " against " << battery::describe(hits[i]);
  }
  EXPECT_GT(found, queries.size() / 4);
}

TEST(Cells, StreamsSayWhatSingleRaysSay) {
  for (const gallery::Scene& scene : gallery::scenes) {
    SCOPED_TRACE(scene.name);
    expect_streams_say_what_single_rays_say(scene.build(), 200);
  }
}

TEST(Cells, EveryInstructionSetSaysTheSame) {
  const CsgTree tree = gallery::random_scene(8, 24, 1.5);
  for_each_instruction_set([&] {
    expect_streams_say_what_single_rays_say(tree, 1000);
    expect_same_answers(tree, "cells", 20);
  });
}

// Rays that go the same way from places far apart: a block of them would open all that lies between, and leaves
// what few of them go through to streams.
TEST(Cells, BlocksWhoseRaysGoApartSayWhatSingleRaysSay) {
  SceneBuilder b;
  Draw draw(35);
  std::vector<SceneNodeId> parts{b.cube({2, 2, 2}, true)};
  for (int i = 0; i < 3000; ++i) parts.push_back(b.translate(draw.in_box({{-1, -1, -1}, {1, 1, 1}}), b.sphere(0.04)));
  const CsgTree tree = b.tree(b.subtract(parts));
  const auto multi_kd = build_accelerator("multi-kd", tree), judged = build_accelerator("cells", tree);
  const auto context = (*multi_kd)->make_context(), other = (*judged)->make_context();
  std::vector<RayQuery> queries;
  for (int i = 0; i < 2048; ++i) {
    RayQuery query;
    query.ray.origin = draw.in_box({{-1.5, -1.5, -1.5}, {1, 1, 1}});
    query.ray.direction = normalize(Vec3{1, 0.7, 0.5} + 0.05 * draw.direction());
    if (i % 3 == 0) query.t_max = draw.real(0, 2);
    query.kind = RayKind::shadow;
    queries.push_back(query);
  }
  const auto [hits, boundaries, occluded] = ask_together(**judged, queries, *other);
  std::size_t found = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Hit hit = (*multi_kd)->first_hit(queries[i], *context);
    found += hit.found();
    ASSERT_TRUE(battery::same_hit(hit, hits[i])) << battery::describe(hit) << " against " << battery::describe(hits[i]);
    ASSERT_EQ(boundaries[i].t, hit.t);
    ASSERT_EQ(occluded[i] != 0, hit.found());
  }
  EXPECT_GT(found, queries.size() / 4);
  EXPECT_LT(found, queries.size());
}

// More work gives more and smaller cells: in a scene of some size, for in a small one a better plane may save some.
TEST(Cells, QualityIsWorkInTheSubdivision) {
  const CsgTree tree = gallery::random_scene(6, 400, 6);
  std::vector<double> counts;
  for (const char* spec : {"cells:quality=fast", "cells", "cells:quality=high"}) {
    const auto accelerator = build_accelerator(spec, tree);
    ASSERT_TRUE(accelerator.ok());
    counts.push_back(detail(**accelerator, "boundary cells"));
  }
  EXPECT_LT(1.5 * counts[0], counts[1]);
  EXPECT_LT(1.5 * counts[1], counts[2]);
}

// Where a build has to stop before its cells are small, in depth or in number, they stay large: in a crowd, and where
// more leaves run through one point than the classifier follows.
TEST(Cells, AreRightWhereTheirLimitsAreReached) {
  const CsgTree crowd = gallery::random_scene(6, 300, 6), point = tangent_spheres(100);
  const auto free = build_accelerator("cells", crowd);
  for (const char* spec : {"cells:depth=3", "cells:depth=8", "cells:most-cells=50", "cells:most-cells=1,depth=60"}) {
    SCOPED_TRACE(spec);
    const auto limited = build_accelerator(spec, crowd);
    ASSERT_TRUE(limited.ok());
    EXPECT_LT(detail(**limited, "boundary cells"), 0.5 * detail(**free, "boundary cells"));
    EXPECT_GT(detail(**limited, "leaves in the fullest cell"), detail(**free, "leaves in the fullest cell"));
    expect_same_answers(crowd, spec, 12);
    expect_same_answers(point, spec, 6);
  }
  EXPECT_LE((*build_accelerator("cells:depth=12", crowd))->figures().depth, 12);
  EXPECT_LE(detail(**build_accelerator("cells:most-cells=1000", crowd), "boundary cells"), 1100);
}

TEST(Cells, SayWhoStandsInForThem) {
  const auto note_of = [](const CsgTree& tree) { return (*build_accelerator("cells", tree))->figures().note; };
  SceneBuilder solid, endless;
  EXPECT_EQ(note_of(solid.tree(solid.sphere(1))), "");
  const CsgTree half = endless.tree(endless.primitive("halfspace", {Vec3{0, 0, 1}, 0.0}));
  EXPECT_NE(note_of(half).find("multi-kd"), std::string::npos);
}

// A direction's length is the unit of t, and may be any: of such as single precision cannot follow, too.
TEST(Cells, FollowDirectionsOfAnyLength) {
  const CsgTree tree = gallery::random_scene(8, 24, 1.5);
  const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
  const auto context = (*none)->make_context(), other = (*judged)->make_context();
  const Box3 box = battery::extent(tree);
  for (const int exponent : {-120, -99, -70, -69, -60, 0, 60, 99, 120}) {
    SCOPED_TRACE(exponent);
    Draw draw(37);
    std::vector<RayQuery> queries(256);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      Vec3 direction = draw.direction();
      if (i % 4 == 0) direction[static_cast<int>(i / 4 % 3)] = 0;
      queries[i].ray = {draw.in_box(grown(box, 0.2 * length(box.size()))), std::ldexp(1.0, exponent) * direction};
    }
    const auto [hits, boundaries, occluded] = ask_together(**judged, queries, *other);
    std::size_t found = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Hit hit = (*none)->first_hit(queries[i], *context);
      found += hit.found();
      ASSERT_TRUE(battery::same_hit(hit, hits[i]))
          << battery::describe(hit) << " against " << battery::describe(hits[i]);
      ASSERT_TRUE(battery::same_hit(hit, (*judged)->first_hit(queries[i], *other)));
      ASSERT_EQ(boundaries[i].t, hit.t);
      ASSERT_EQ(occluded[i] != 0, hit.found());
    }
    EXPECT_GT(found, queries.size() / 8);
  }
}

// The tree is the same for any number of threads, and any set of instructions.
TEST(Cells, AreBuiltAlikeByEverybody) {
  const CsgTree tree = gallery::random_scene(6, 300, 6);
  const Box3 box = battery::extent(tree);
  const CellTree one = CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, 1});
  ASSERT_GT(one.cells.size(), 100u);
  const auto expect_the_same = [&](const CellTree& other) {
    ASSERT_EQ(one.cells.size(), other.cells.size());
    ASSERT_EQ(one.nodes.size(), other.nodes.size());
    for (std::size_t i = 0; i < one.cells.size(); ++i) {
      ASSERT_EQ(one.cells[i].table, other.cells[i].table);
      ASSERT_EQ(one.cells[i].leaves, other.cells[i].leaves);
    }
    for (std::size_t i = 0; i < one.nodes.size(); ++i) ASSERT_EQ(one.nodes[i].ends, other.nodes[i].ends);
  };
  expect_the_same(CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, 4}));
  for_each_instruction_set([&] {
    expect_the_same(CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, 1}));
  });
}

// What is left of an expression says the same as the whole wherever the constant leaves are as assumed: whether a point
// is of the solid, of which medium, and, where that is told, who owns it.
void expect_folded_says_what_the_whole_says(const CsgTree& tree, Draw& draw) {
  const OwnerRanks ranks(tree);
  const LocalExpression whole = cells::whole_expression(tree, ranks);
  const Expression compiled = Expression::compile(tree);
  std::vector<Region> regions;
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) regions.push_back(static_cast<Region>(draw.below(3)));
  // In two steps, for what was folded once is folded again.
  std::vector<Region> coarse = regions;
  for (Region& region : coarse) {
    if (draw.one_in(2)) region = Region::straddles;
  }
  Folder folder(ranks);
  LocalExpression half, left;
  cells::Folded folded = folder.fold(
      whole, [&](LeafId leaf) { return coarse[leaf.get()]; }, half);
  if (!folded.constant)
    folded = folder.fold(
        half, [&](LeafId leaf) { return regions[leaf.get()]; }, left);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<bool> inside;
    for (const Region region : regions) {
      inside.push_back(region == Region::inside || (region == Region::straddles && draw.one_in(2)));
    }
    ExpressionState oracle(compiled);
    oracle.reset();
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (inside[i]) oracle.flip(LeafId{i});
    }
    // The rule for owners, by all leaves there are.
    LeafId owner;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (!inside[i] || !oracle.owns(LeafId{i})) continue;
      if (!owner || tree.leaves[i].priority > tree[owner].priority) owner = LeafId{i};
    }
    const auto holds = [&](LeafId leaf) { return inside[leaf.get()]; };
    EXPECT_EQ(cells::evaluate(whole, holds).value, oracle.value());
    const cells::PointValue point =
        folded.constant ? cells::PointValue{folded.value, folded.owner} : cells::evaluate(left, holds);
    ASSERT_EQ(point.value, oracle.value());
    if (!point.value) continue;
    const MediumId medium = owner && tree.has_media ? tree[owner].medium : medium_opaque;
    ASSERT_EQ(ranks.medium(point.owner), medium);
    if (point.owner.is_nobody()) {
      EXPECT_FALSE(owner);
    } else if (!point.owner.varies()) {
      EXPECT_EQ(ranks.leaf(point.owner), owner);
    }
  }
}

TEST(LocalExpression, FoldedSaysWhatTheWholeSays) {
  constexpr std::uint64_t seed = 33;
  Draw draw(seed);
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", round " << round);
    CsgTree tree = gallery::random_scene(static_cast<std::uint64_t>(100 + round), 2 + draw.below(14), 1);
    expect_folded_says_what_the_whole_says(tree, draw);
    // The same tree with priorities, then with media, too.
    for (Leaf& leaf : tree.leaves) leaf.priority = draw.below(3);
    expect_folded_says_what_the_whole_says(tree, draw);
    tree.has_media = true;
    for (Leaf& leaf : tree.leaves) leaf.medium = static_cast<MediumId>(medium_opaque + draw.below(3));
    expect_folded_says_what_the_whole_says(tree, draw);
    for (Leaf& leaf : tree.leaves) leaf.priority = 0;
    expect_folded_says_what_the_whole_says(tree, draw);
  }
}

}  // namespace
}  // namespace tenon
