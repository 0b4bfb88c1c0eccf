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

// What is met of many solids is told without their spans(): by rays from afar, and by those that start on them and go
// inward.
// @param most  of those that are met, so many may ask all the same
void expect_told_without_spans(const CsgTree& tree, Draw& draw, double most) {
  expect_same_answers(tree, "cells", 400);
  expect_streams_say_what_single_rays_say(tree, 4000);
  const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
  const auto context = (*none)->make_context(), other = (*judged)->make_context();
  const Box3 box = battery::extent(tree);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 at = draw.in_box(box), from = at + 10 * draw.direction();
    const RayQuery query{{from, at - from}};
    const Hit start = (*none)->first_hit(query, *context);
    ASSERT_TRUE(battery::same_hit(start, (*judged)->first_hit(query, *other)));
    if (!start.found()) continue;
    RayQuery inward{{start.point, draw.direction()}};
    if (dot(inward.ray.direction, start.normal) > 0) inward.ray.direction = -inward.ray.direction;
    inward.from = &start;
    const Hit hit = (*none)->first_hit(inward, *context), told = (*judged)->first_hit(inward, *other);
    ASSERT_TRUE(battery::same_hit(hit, told)) << battery::describe(hit) << " against " << battery::describe(told);
    met += 1 + static_cast<int>(hit.found());
  }
  EXPECT_GT(met, 2000);
  const TraversalCounters counters = other->statistics.total();
  EXPECT_LT(static_cast<double>(counters.primitive_tests - counters.cells_visited), most * met);
}

// Rays are steeper than the side, too.
TEST(Cells, TellQuadricsOfRevolutionByThemselves) {
  Draw draw(40);
  for (int i = 0; i < 8; ++i) {
    SCOPED_TRACE(i);
    SceneBuilder b;
    const SceneNodeId solids[] = {b.primitive("cone", {1.0, 0.8, 0.2, false}),
                                  b.primitive("cone", {1.0, 0.0, 1.7, true}),
                                  b.primitive("hyperboloid", {1.0, 0.8, 0.3}), b.primitive("paraboloid", {1.0, 0.6})};
    const Vec3 turn = i % 2 == 0 ? Vec3{0, 0, 0} : Vec3{20.0 * i, 50, 0};
    const Affine3 scale = Affine3::scale({1, 1, draw.real(0.5, 2)});
    const CsgTree tree = b.tree(b.rotate(turn, b.transform(scale, solids[i / 2])));
    // A line that meets the hyperboloid twice within the cell is left to the classifier.
    expect_told_without_spans(tree, draw, i / 2 == 2 ? 0.5 : 0.01);
  }
}

TEST(Cells, TellPrismsAndPolyhedraByThemselves) {
  Draw draw(41);
  for (int i = 0; i < 9; ++i) {
    SCOPED_TRACE(i);
    SceneBuilder b;
    const bool is_prism = i % 2 == 0;
    const int sides = i < 8 ? 3 + 2 * i : 39;
    Outline star{{{}, {}}};
    std::vector<Plane> planes{{{0, 0, 1}, 1}, {{0, 0, -2}, 1}};
    for (int k = 0; k < sides; ++k) {
      const double angle = 360.0 * k / sides, c = cos_degrees(angle), s = sin_degrees(angle);
      const double r = draw.real(0.6, 1.2);
      star.loops[0].push_back({r * c, r * s, i < 2 || k % 2 == 0 ? 0 : draw.real(-0.3, 0.6)});
      if (k < 3) star.loops[1].push_back({0.2 * (k % 2), 0.2 * (k / 2), 0});
      planes.push_back({draw.real(0.5, 2) * Vec3{c, s, draw.real(-0.3, 0.3)}, 0.8});
    }
    const SceneNodeId solid =
        is_prism ? b.primitive("prism", {star, 1.5, i % 4 == 0, 1.0}) : b.primitive("convex_polyhedron", {planes});
    const Vec3 turn = i < 4 ? Vec3{0, 0, 0} : Vec3{20.0 * i, 50, 0};
    // What comes near to a corner, or starts on an arc and meets that again, is not told so; nor what goes through a
    // crowd of walls.
    const CsgTree tree = b.tree(b.rotate(turn, b.transform(Affine3::scale({1, 1.3, 0.8}), solid)));
    expect_told_without_spans(tree, draw, i == 8 ? 0.5 : is_prism ? 0.1 : 0.01);
  }
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

void expect_the_same(const CellTree& one, const CellTree& other) {
  ASSERT_EQ(one.cells.size(), other.cells.size());
  ASSERT_EQ(one.nodes.size(), other.nodes.size());
  for (std::size_t i = 0; i < one.cells.size(); ++i) {
    ASSERT_EQ(one.cells[i].table, other.cells[i].table);
    ASSERT_EQ(one.cells[i].leaves, other.cells[i].leaves);
  }
  for (std::size_t i = 0; i < one.nodes.size(); ++i) ASSERT_EQ(one.nodes[i].ends, other.nodes[i].ends);
}

// The tree is the same for any number of threads, and any set of instructions.
TEST(Cells, AreBuiltAlikeByEverybody) {
  const CsgTree tree = gallery::random_scene(6, 300, 6);
  const Box3 box = battery::extent(tree);
  const CellTree one = CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, 1});
  ASSERT_GT(one.cells.size(), 100u);
  expect_the_same(one, CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, 4}));
  for_each_instruction_set([&] {
    expect_the_same(one, CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, 1}));
  });
}

// So many leaves that parts of the tree are appended while others are still built.
TEST(Cells, OfManyLeavesAreBuiltAlikeByManyThreads) {
  const CsgTree tree = gallery::random_scene(7, 5000, 30);
  const Box3 box = battery::extent(tree);
  const CellTree one = CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, 1});
  ASSERT_GT(one.cells.size(), 10000u);
  expect_the_same(one, CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, 5}));
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
