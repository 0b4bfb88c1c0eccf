#include <cmath>
#include <numbers>

#include "accel/cells_checks.h"

namespace tenon {
namespace {

using fixtures::Draw;
using fixtures::SceneBuilder;
using namespace cells_checks;

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

// What an outline goes there and back bounds nothing, though its walls bound what looks like a wedge.
TEST(Cells, FollowWallsThatGoThereAndBack) {
  Draw draw(61);
  for (int round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    SceneBuilder b;
    Outline outline{{{}}};
    const int corners = 3 + round % 4;
    for (int i = 0; i < corners; ++i) {
      const double angle = 360.0 * i / corners + draw.real(0, 20), r = draw.real(0.8, 1.2);
      outline.loops[0].push_back({r * cos_degrees(angle), r * sin_degrees(angle), 0});
    }
    // From a corner inwards or outwards, and perhaps half as far again.
    const OutlineCorner corner = outline.loops[0].back();
    const auto add = [&](double share) { outline.loops[0].push_back({share * corner.x, share * corner.y, 0}); };
    const double end = round % 3 == 0 ? 1.4 : draw.real(-0.2, 0.6);
    add(end);
    if (round % 4 == 1) {
      add(1);
      add(0.5 * (1 + end));
    }
    // Or a loop of nothing but an edge, from within.
    if (round % 4 == 2) outline.loops.push_back({{0.1, 0.05, 0}, {draw.real(0.2, 0.6), draw.real(-0.4, 0.4), 0}});
    const CsgTree tree = b.tree(b.primitive("prism", {outline, 0.7, false, round == 7 ? 0.6 : 1.0}));
    for (const char* spec : {"cells", "cells:quality=fast"}) expect_same_answers(tree, spec, 300);
    expect_streams_say_what_single_rays_say(tree, 4000);
  }
}

// The same of two walls that are one but for rounding, and a third near by: the shorter first or last, or neither all
// along the other.
TEST(Cells, FollowWallsThatNearlyGoThereAndBack) {
  const std::vector<OutlineCorner> below{{4.5, 0.25, 0}, {10.5, 0.85, 0}, {10.5, -1, 0}, {4.5, -1, 0}};
  const std::vector<OutlineCorner> under{{2.5, -0.3, 0}, {13.5, -0.3, 0}, {13.5, -2, 0}, {2.5, -2, 0}};
  const Outline outlines[] = {
      {{{{0, 3, 0}, {5, 3, 0}, {5, 0.5 + 4.5e-13, 0}, {10, 1, 0}, {0, 0, 0}}, below}},
      {{{{0, 0, 0}, {10, 1, 0}, {5, 0.5 + 4.5e-13, 0}, {5, 3, 0}, {0, 3, 0}}, below}},
      {{{{0, 0, 0}, {10, 0, 0}, {13, -1.35e-12, 0}, {3, 7e-13, 0}, {3, 3, 0}, {0, 3, 0}}, under}}};
  for (const Outline& outline : outlines) {
    SceneBuilder b;
    const CsgTree tree = b.tree(b.primitive("prism", {outline, 1.0, false, 1.0}));
    for (const char* spec : {"cells", "cells:quality=fast"}) expect_same_answers(tree, spec, 2000);
  }
}

// Twisted prisms come to a few walls in small cells, which turn past the ray: segments and arcs, scaled on the way or
// not, with holes, and through one another.
TEST(Cells, FollowTwistedPrismsByTheirWalls) {
  Draw draw(47);
  for (int round = 0; round < 8; ++round) {
    SCOPED_TRACE(round);
    const bool has_arcs = round % 4 >= 2;
    SceneBuilder b;
    const auto twisted = [&](double size, double turn) {
      Outline outline{{{}, {}}};
      const int corners = 3 + round;
      for (int i = 0; i < corners; ++i) {
        const double r = size * draw.real(0.5, 1), angle = 360.0 * i / corners;
        const double bulge = has_arcs && i % 2 == 0 ? draw.real(-0.4, 1) : 0;
        outline.loops[0].push_back({r * cos_degrees(angle), r * sin_degrees(angle), bulge});
      }
      for (int i = 0; i < 4; ++i) outline.loops[1].push_back({0.2 * (i == 1 || i == 2), 0.15 * (i > 1), 0});
      const double scale_x = round % 2 == 0 ? 1 : draw.real(0.3, 1.6), scale_y = round == 3 ? 0.8 : scale_x;
      return b.primitive("twisted_prism", {outline, 1.0, round % 2 == 0, turn, scale_x, scale_y});
    };
    const SceneNodeId block = b.translate({0.6, 0, 0.5}, b.cube({1.2, 1.2, 1.2}));
    const SceneNodeId bodies =
        b.unite({twisted(1, 90), b.translate({0.3, 0, 0.4}, b.rotate({0, 0, 20}, twisted(0.8, -60))), block,
                 b.rotate({70, 30, 0}, twisted(0.7, 200))});
    const SceneNodeId tools =
        b.unite({b.translate({0.2, 0.1, -1}, b.cylinder(4, 0.2)), b.translate({1, 0.5, 0.7}, b.sphere(0.4)),
                 b.translate({0.7, 0, -0.5}, b.scale(0.4, b.transform(Affine3::scale({1, 1, 6}), twisted(1, 720))))});
    const CsgTree tree = b.tree(b.subtract({bodies, tools}));
    for (const char* spec : {"cells", "cells:quality=fast"}) expect_same_answers(tree, spec, 300);
    expect_streams_say_what_single_rays_say(tree, 4000);
    const auto cells = build_accelerator("cells", tree);
    EXPECT_LT(detail(**cells, "cells with leaves of no special kind"), 0.5 * detail(**cells, "boundary cells"));
  }
}

// What a scale is wrong by counts by how far away the ends of a wall are.
TEST(Cells, FollowTwistedPrismsWhoseWallsReachFar) {
  Draw draw(53);
  for (int round = 0; round < 4; ++round) {
    SCOPED_TRACE(round);
    SceneBuilder b;
    const double far = round < 2 ? 70 : 4, height = round % 2 == 0 ? 1 : 0.1;
    const auto wedge = [&](double turn) {
      const double x = draw.real(0.8, 1.2) * far, y = draw.real(0.8, 1.2) * far;
      const Outline outline{{{{-x, -y, 0}, {x, y - draw.real(0, 0.1), 0}, {draw.real(-0.2, 0), 0.3 * far, 0}}}};
      return b.primitive("twisted_prism", {outline, height, true, turn, draw.real(0.2, 2), draw.real(0.2, 2)});
    };
    const SceneNodeId room = b.cube({1, 1, 2 * height}, true);
    const SceneNodeId both = b.unite({wedge(draw.real(-60, 60)), b.rotate({0, 0, 140}, wedge(draw.real(-60, 60)))});
    const CsgTree tree = b.tree(b.intersect({room, both}));
    expect_same_answers(tree, "cells", 300, 0.01);
    expect_streams_say_what_single_rays_say(tree, 4000);
  }
}

// A twisted prism is cut into small parts, but not into any number of them: not where it turns a hundred times, nor
// where no part of it comes to walls that can be followed.
TEST(Cells, AreNotWithoutEndOfTwistedPrisms) {
  const Outline round{{{{0.3, 0, 1}, {0.9, 0, 1}}}}, bellied{{{{1, 0, 1.5}, {1, 0.5, 0}, {0.5, 0.5, 0}, {0.5, 0, 0}}}};
  for (const Outline& outline : {round, bellied}) {
    for (const double twist : {90.0, 1800.0, 36000.0}) {
      SceneBuilder b;
      const CsgTree tree = b.tree(b.primitive("twisted_prism", {outline, 2.0, false, twist, 1.0, 1.0}));
      const auto cells = build_accelerator("cells", tree);
      EXPECT_LT(detail(**cells, "boundary cells"), 60000) << twist;
    }
  }
}

// Rays that start just above the topmost face and leave go through no cell; those that go down do.
TEST(Cells, AreNotEnteredByRaysThatLeaveTheScene) {
  SceneBuilder b;
  const Outline triangle{{{{-3, -2, 0}, {3, -2, 0}, {0, 4, 0}}}};
  const CsgTree tree = b.tree(b.primitive("prism", {triangle, 1.0, false, 1.0}));
  const auto cells = build_accelerator("cells", tree);
  ASSERT_TRUE(cells.ok());
  const auto context = (*cells)->make_context();
  Draw draw(59);
  for (const double side : {1.0, -1.0}) {
    const auto before = context->statistics[RayKind::primary].cells_visited;
    for (int i = 0; i < 100; ++i) {
      Vec3 direction = draw.direction();
      direction.z = side * std::max(std::fabs(direction.z), 0.1);
      const Hit hit = (*cells)->first_hit({{{draw.real(-1, 1), draw.real(-1, 1), 1 + 4e-6}, direction}}, *context);
      EXPECT_EQ(hit.found(), side < 0);
    }
    const auto visited = context->statistics[RayKind::primary].cells_visited - before;
    if (side > 0) {
      EXPECT_EQ(visited, 0u);
    } else {
      EXPECT_GE(visited, 100u);
    }
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

}  // namespace
}  // namespace tenon
