#include "accel/cells/cell_tree.h"
#include "accel/cells_checks.h"
#include "support/instruction_sets.h"

// Scenes of several media, against `none`: which medium a point is of follows from who owns it.
namespace tenon {
namespace {

using namespace cells_checks;
using fixtures::random_place;

constexpr MediumId glass = 2, water = 3, ice = 4;

/// What a leaf is made of.
struct Matter {
  MediumId medium = medium_opaque;
  double priority = 0;
  bool has_material = true;
};

/// Gives each leaf what it is made of, in tree order; the last of the list to all that follow.
CsgTree made_of(CsgTree tree, const std::vector<Matter>& matters) {
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const Matter& matter = matters[std::min(i, matters.size() - 1)];
    Leaf& leaf = tree.leaves[i];
    leaf.medium = matter.medium;
    leaf.priority = matter.priority;
    leaf.material = matter.has_material ? MaterialId{matter.medium} : MaterialId{};
    tree.has_media |= matter.medium > medium_opaque;
  }
  return tree;
}

CsgTree random_media(Draw& draw, CsgTree tree, int media, int priorities) {
  std::vector<Matter> matters;
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    matters.push_back({static_cast<MediumId>(medium_opaque + draw.below(media)),
                       static_cast<double>(draw.below(priorities)), !draw.one_in(4)});
  }
  return made_of(std::move(tree), matters);
}

/// That `cells` traces the scene itself, at every quality.
void expect_cells_say_what_none_says(const CsgTree& tree, int rounds, double least_hits = 0.1) {
  const auto accelerator = build_accelerator("cells", tree);
  ASSERT_TRUE(accelerator.ok());
  EXPECT_GT(detail(**accelerator, "boundary cells"), 0);
  for (const char* spec : {"cells", "cells:quality=fast", "cells:quality=high"}) {
    expect_same_answers(tree, spec, rounds, least_hits);
  }
  expect_streams_say_what_single_rays_say(tree, 10 * rounds);
}

/// Balls, boxes or cylinders in one another, of a medium each; the last in the list outermost.
CsgTree nest(const std::vector<SceneNodeId>& shells, SceneBuilder& b, const std::vector<Matter>& matters) {
  return made_of(b.tree(b.unite(shells)), matters);
}

TEST(CellsMedia, ANestOfBalls) {
  SceneBuilder b;
  expect_cells_say_what_none_says(nest({b.sphere(0.3), b.translate({0.1, 0, 0}, b.sphere(0.6)), b.sphere(1),
                                        b.translate({0, 0.2, 0}, b.sphere(1.3))},
                                       b, {{}, {ice, 2}, {water, 1}, {glass, 3}}),
                                  20);
}

TEST(CellsMedia, ANestByPriorityAlone) {
  // The outermost stands first in the file, and comes last.
  SceneBuilder b;
  expect_cells_say_what_none_says(
      nest({b.cube({3, 3, 3}, true), b.cylinder(2, 1, true), b.rotate({10, 20, 30}, b.cube({1, 1, 1}, true))}, b,
           {{water, 1}, {glass, 2}, {medium_opaque, 3}}),
      20);
}

TEST(CellsMedia, TouchingSolidsOfOneMediumShowNoWall) {
  SceneBuilder b;
  const CsgTree tree = made_of(b.tree(b.unite({b.cube({1, 1, 1}), b.translate({1, 0, 0}, b.cube({1, 1, 1})),
                                               b.translate({0, 1, 0}, b.cube({2, 1, 0.5}))})),
                               {{glass, 0}});
  expect_cells_say_what_none_says(tree, 20);
  fixtures::Tracer tracer(tree, "cells");
  const Hit in = tracer.first_hit({{-1, 0.4, 0.3}, {1, 0.01, 0.02}});
  const Hit out = tracer.first_hit({in.point, {1, 0.01, 0.02}}, &in);
  EXPECT_NEAR(out.point.x, 2, 1e-9);
}

TEST(CellsMedia, TouchingSolidsOfTwoMediaAreOneBoundary) {
  const auto blocks = [](const Vec3& degrees) {
    SceneBuilder b;
    const SceneNodeId both = b.unite({b.cube({1, 1, 1}), b.translate({1, 0, 0}, b.cube({1, 1, 1}))});
    return made_of(b.tree(b.rotate(degrees, both)), {{glass, 1}, {water, 0}});
  };
  expect_cells_say_what_none_says(blocks({}), 20);
  expect_cells_say_what_none_says(blocks({12.7, 48.1, 77.7}), 20);

  const CsgTree tree = blocks({});
  fixtures::Tracer tracer(tree, "cells");
  const Hit in = tracer.first_hit({{-1, 0.4, 0.3}, {1, 0.01, 0.02}});
  const Hit between = tracer.first_hit({in.point, {1, 0.01, 0.02}}, &in);
  EXPECT_EQ(between.before, glass);
  EXPECT_EQ(between.after, water);
  EXPECT_EQ(between.faces.size(), 2u);
}

// Water that fills a vessel: its face is that of the hollow, and three media lie around the rim.
SceneNodeId tumbler(SceneBuilder& b, bool tapered) {
  const auto body = [&](double h, double r) {
    return tapered ? b.primitive("cone", {h, r, 1.2 * r, false}) : b.cylinder(h, r);
  };
  const SceneNodeId hollow = b.translate({0, 0, 0.2}, body(1.8, 0.8));
  return b.unite({b.subtract({body(2, 1), hollow}),
                  b.intersect({hollow, b.translate({-2, -2, 0}, b.cube({4, 4, 1.5}))}),
                  b.translate({0.2, 0, 1.4}, b.rotate({20, 30, 0}, b.cube({0.6, 0.6, 0.6}, true))),
                  b.translate({0.2, 0, 1.4}, b.sphere(0.2))});
}

TEST(CellsMedia, WaterInAVesselFlushWithIt) {
  for (const bool tapered : {false, true}) {
    SCOPED_TRACE(tapered);
    SceneBuilder b;
    const CsgTree tree = made_of(b.tree(tumbler(b, tapered)),
                                 {{glass, 3}, {glass, 3}, {water, 1}, {water, 1}, {ice, 2}, {medium_opaque, 5}});
    expect_cells_say_what_none_says(tree, 60);
    const auto accelerator = build_accelerator("cells", tree);
    EXPECT_GT(detail(**accelerator, "cells of more media"), 0);
  }
}

TEST(CellsMedia, FacesOfALattice) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Draw draw(seed);
    for (const Vec3& degrees : {Vec3{}, Vec3{12.7, 48.1, 77.7}}) {
      expect_cells_say_what_none_says(
          random_media(draw, gallery::lattice_scene(40 + seed, degrees), 4, 1 + draw.below(3)), 6);
    }
  }
}

TEST(CellsMedia, RandomScenes) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Draw draw(seed);
    SceneBuilder b;
    const auto parts = gallery::random_parts(draw, b, 4 + draw.below(20), 1.2, false);
    // Within a ball, for complements have no end; a ring, for little may be left.
    const CsgTree tree = b.tree(b.unite({b.intersect({b.sphere(4), random_tree(draw, b, parts)}), b.torus(1, 0.3)}));
    expect_cells_say_what_none_says(random_media(draw, tree, 2 + draw.below(6), 1 + draw.below(4)), 4, 0);
  }
}

// Cells below, at and above what a word has room for, of more media than a table tells apart, and beyond what a ray is
// followed through.
TEST(CellsMedia, AnyNumberOfLeaves) {
  for (const int count : {4, 6, 7, 10, 11, 15, 64, 100}) {
    for (const int media : {3, 12}) {
      SCOPED_TRACE(testing::Message() << count << " leaves, " << media << " media");
      Draw draw(static_cast<std::uint64_t>(count));
      expect_cells_say_what_none_says(random_media(draw, tangent_spheres(count), media, 3), 4);
    }
  }
}

// Twelve balls through one point, each of a medium of its own: a part of six leaves may hold more than eight.
TEST(CellsMedia, MoreMediaThanATableTellsApart) {
  SceneBuilder b;
  Draw draw(51);
  std::vector<SceneNodeId> parts;
  std::vector<Matter> matters;
  for (int i = 0; i < 24; ++i) {
    parts.push_back(b.translate(draw.direction() * 0.7, b.sphere(i < 12 ? 0.7 : 1.1)));
    matters.push_back({static_cast<MediumId>(glass + i), static_cast<double>(i < 12 ? 0 : draw.below(5))});
  }
  expect_cells_say_what_none_says(made_of(b.tree(b.unite(parts)), matters), 30);
}

// Walls of one medium in another, so thin that the two faces are nearer to each other than the cells can tell.
TEST(CellsMedia, ThinFilms) {
  for (const double thickness : {1e-3, 1e-6, 1e-9}) {
    SCOPED_TRACE(thickness);
    SceneBuilder b;
    const CsgTree tree = b.tree(b.unite({b.subtract({b.sphere(1), b.sphere(1 - thickness)}), b.sphere(1 - thickness),
                                         b.rotate({10, 20, 30}, b.cube({3, 3, thickness}, true))}));
    expect_cells_say_what_none_says(made_of(tree, {{glass, 2}, {glass, 2}, {water, 1}, {ice, 3}}), 12);
  }
}

// A tool without a material shows who owns what it cut; of opaque solids in glass that is who is seen.
TEST(CellsMedia, CutFacesShowWhoOwnsThem) {
  SceneBuilder b;
  const SceneNodeId bodies = b.unite(
      {b.sphere(1), b.translate({0.5, 0, 0}, b.cube({2, 0.5, 0.5}, true)), b.translate({0, 0.7, 0}, b.sphere(0.8))});
  const CsgTree tree = b.tree(b.subtract({bodies, b.translate({0, 0.3, 0.6}, b.sphere(0.7))}));
  for (const Matter& second : {Matter{medium_opaque, 0}, Matter{medium_opaque, 2}, Matter{water, 2}}) {
    expect_cells_say_what_none_says(made_of(tree, {{glass, 1}, second, {medium_opaque, 0}, {medium_opaque, 0, false}}),
                                    40);
  }
}

// Without media priorities say whose a cut is.
TEST(CellsMedia, PrioritiesOfOpaqueSolidsAlone) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Draw draw(seed);
    SceneBuilder b;
    std::vector<SceneNodeId> bodies, tools;
    for (int i = 0; i < 10; ++i) {
      bodies.push_back(random_place(draw, b, 1, b.cube({1, 1, 1}, true)));
      tools.push_back(random_place(draw, b, 1, b.sphere(0.4)));
    }
    CsgTree tree = b.tree(b.subtract({b.unite(bodies), b.unite(tools)}));
    std::vector<Matter> matters;
    for (int i = 0; i < 10; ++i) matters.push_back({medium_opaque, static_cast<double>(draw.below(3))});
    matters.push_back({medium_opaque, 0, false});
    tree = made_of(std::move(tree), matters);
    for (std::size_t i = 0; i < 10; ++i) tree.leaves[i].material = MaterialId{i};
    ASSERT_FALSE(tree.has_media);
    expect_cells_say_what_none_says(tree, 12);
  }
}

TEST(CellsMedia, EveryInstructionSetSaysTheSame) {
  SceneBuilder b;
  const CsgTree vessel = made_of(b.tree(tumbler(b, false)),
                                 {{glass, 3}, {glass, 3}, {water, 1}, {water, 1}, {ice, 2}, {medium_opaque, 5}});
  Draw draw(61);
  const CsgTree random = random_media(draw, gallery::random_scene(8, 24, 1.5), 5, 3);
  for_each_instruction_set([&] {
    for (const CsgTree& tree : {vessel, random}) {
      expect_streams_say_what_single_rays_say(tree, 600);
      expect_same_answers(tree, "cells", 12);
    }
  });
}

// The tree is the same for any number of threads.
TEST(CellsMedia, AreBuiltAlikeByEverybody) {
  Draw draw(62);
  const CsgTree tree = random_media(draw, gallery::random_scene(6, 300, 6), 5, 3);
  const Box3 box = battery::extent(tree);
  const auto build = [&](int threads) {
    return cells::CellTree::build(tree, box, cells::CellScale::of(tree), {{}, {}, threads});
  };
  const cells::CellTree one = build(1), four = build(4);
  ASSERT_GT(one.cells.size(), 100u);
  ASSERT_EQ(one.cells.size(), four.cells.size());
  for (std::size_t i = 0; i < one.cells.size(); ++i) {
    ASSERT_EQ(one.cells[i].table, four.cells[i].table);
    ASSERT_EQ(one.cells[i].owner_or_media, four.cells[i].owner_or_media);
  }
  ASSERT_EQ(one.media, four.media);
}

// Rays of a picture that look into a nest from within it, many at a time.
TEST(CellsMedia, ACameraInsideOfEachNest) {
  SceneBuilder b;
  const CsgTree tree = nest({b.sphere(0.3), b.cube({1.4, 1.4, 1.4}, true), b.sphere(1.3)}, b,
                            {{medium_opaque, 3}, {water, 2}, {glass, 1}});
  const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
  const auto context = (*none)->make_context(), other = (*judged)->make_context();
  const std::pair<double, MediumId> eyes[] = {{0.5, water}, {0.9, glass}, {3, medium_outside}};
  for (const auto& [distance, medium] : eyes) {
    std::vector<RayQuery> queries;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        RayQuery query;
        query.ray = {{distance, 0.02, 0.01}, {-1, (x - 15.7) / 32, (y - 15.6) / 32}};
        queries.push_back(query);
      }
    }
    std::vector<Hit> hits(queries.size());
    (*judged)->first_hits(queries, hits, *other);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Hit hit = (*none)->first_hit(queries[i], *context);
      ASSERT_TRUE(battery::same_hit(hit, hits[i]))
          << battery::describe(hit) << " against " << battery::describe(hits[i]);
      ASSERT_TRUE(!hit.found() || hit.before == medium);
    }
  }
}

}  // namespace
}  // namespace tenon
