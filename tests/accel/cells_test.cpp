#include "accel/battery.h"
#include "accel/cells/cell_tree.h"
#include "csg/expression.h"
#include "csg/minimum_enclosure.h"
#include "support/instruction_sets.h"

namespace tenon {
namespace {

using cells::CellTree;
using cells::Folder;
using cells::LocalExpression;
using cells::Owner;
using fixtures::Draw;
using fixtures::SceneBuilder;

void expect_same_answers(const CsgTree& tree, const std::string& spec, int rounds = 60) {
  const auto none = build_accelerator("none", tree), judged = build_accelerator(spec, tree);
  ASSERT_TRUE(judged.ok()) << judged.error().message;
  const battery::Verdict verdict = battery::judge(**none, **judged, battery::make_rays(tree, **none, rounds, 31));
  EXPECT_EQ(verdict.mismatches, 0u) << spec << " of " << verdict.rays << " rays; the first:\n" << verdict.first;
  EXPECT_EQ(verdict.seam_faults, 0u);
  EXPECT_GT(verdict.hits, verdict.rays / 10);
}

double detail(const Accelerator& accelerator, std::string_view what) {
  for (const auto& one : accelerator.figures().details) {
    if (one.what == what) return one.value;
  }
  ADD_FAILURE() << "no figure is called " << what;
  return 0;
}

// Spheres that all touch one plane at the origin, from both sides: whatever contains that point straddles all.
CsgTree tangent_spheres(int count) {
  SceneBuilder b;
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < count; ++i) {
    const double r = (i % 2 == 0 ? 1 : -1) * (0.5 + 0.07 * i);
    parts.push_back(b.translate({0, 0, r}, b.sphere(std::fabs(r))));
  }
  std::vector<SceneNodeId> rings;
  for (std::size_t i = 0; i + 1 < parts.size(); i += 2) rings.push_back(b.subtract({parts[i + 1], parts[i]}));
  if (parts.size() % 2 == 1) rings.push_back(parts.back());
  return b.tree(b.subtract({b.unite(rings), b.translate({0.3, 0.2, 0}, b.sphere(0.4))}));
}

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

struct Answers {
  std::vector<Hit> hits;
  std::vector<RayBoundary> boundaries;
  std::vector<std::uint8_t> occluded;
};

// All that may be asked of many rays at once.
Answers ask_together(const Accelerator& accelerator, std::span<const RayQuery> queries, TraceContext& context) {
  const std::size_t count = queries.size();
  Answers answers{std::vector<Hit>(count), std::vector<RayBoundary>(count), std::vector<std::uint8_t>(count)};
  accelerator.first_hits(queries, answers.hits, context);
  accelerator.first_boundaries(queries, answers.boundaries, context);
  accelerator.occluded(queries, answers.occluded, context);
  return answers;
}

// Rays in all directions, which are followed several at once; from free space, from what they met, along
// axes, to an end, and from further off than single precision can tell.
void expect_streams_say_what_single_rays_say(const CsgTree& tree, int count) {
  const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
  const auto context = (*none)->make_context(), other = (*judged)->make_context();
  const Box3 box = battery::extent(tree);
  Draw draw(36);
  std::vector<RayQuery> queries;
  for (int i = 0; i < count; ++i) {
    RayQuery query;
    query.ray = {draw.in_box(grown(box, 0.2 * length(box.size()))), draw.direction()};
    if (i % 7 == 0) query.ray.direction[i / 7 % 3] = 0;
    if (i % 5 == 0) query.t_max = draw.real(0, length(box.size()));
    if (i % 50 == 0) query.ray.origin = query.ray.origin - 1e6 * length(box.size()) * query.ray.direction;
    query.kind = RayKind::diffuse;
    queries.push_back(query);
  }
  std::vector<Hit> starts(queries.size());
  for (std::size_t i = 0; i < starts.size(); ++i) starts[i] = (*none)->first_hit(queries[i], *context);
  for (const Hit& start : starts) {
    if (!start.found()) continue;
    RayQuery query;
    query.ray = {start.point, draw.direction()};
    query.from = &start;
    query.kind = queries.size() % 3 == 0 ? RayKind::reflected : RayKind::diffuse;
    queries.push_back(query);
  }
  const auto [hits, boundaries, occluded] = ask_together(**judged, queries, *other);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Hit hit = (*none)->first_hit(queries[i], *context);
    ASSERT_TRUE(battery::same_hit(hit, hits[i]))
        << battery::describe(queries[i]) << ": " << battery::describe(hit) << " against " << battery::describe(hits[i]);
    ASSERT_EQ(boundaries[i].found(), hit.found()) << battery::describe(queries[i]);
    ASSERT_EQ(occluded[i] != 0, hit.found()) << battery::describe(queries[i]);
    if (!hit.found()) continue;
    EXPECT_EQ(boundaries[i].t, hit.t);
    EXPECT_EQ(boundaries[i].surface, hit.surface);
  }
  EXPECT_EQ(other->statistics.seam_faults, 0u);
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

// Rays that go the same way from places far apart: a block of them would open all that lies between, and is given up.
TEST(Cells, BlocksThatDoNotPaySayWhatSingleRaysSay) {
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

// The tree is the same for any number of threads, and any set of instructions.
TEST(Cells, AreBuiltAlikeByEverybody) {
  const CsgTree tree = gallery::random_scene(6, 300, 6);
  const Box3 box = battery::extent(tree);
  const CellTree one = CellTree::build(tree, box, {}, 1);
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
  expect_the_same(CellTree::build(tree, box, {}, 4));
  for_each_instruction_set([&] { expect_the_same(CellTree::build(tree, box, {}, 1)); });
}

// What is left of an expression says the same as the whole wherever the constant leaves are as assumed.
TEST(LocalExpression, FoldedSaysWhatTheWholeSays) {
  Draw draw(33);
  for (int round = 0; round < 200; ++round) {
    const CsgTree tree = gallery::random_scene(static_cast<std::uint64_t>(100 + round), 2 + draw.below(14), 1);
    const LocalExpression whole = cells::whole_expression(tree);
    const Expression compiled = Expression::compile(tree);
    std::vector<Region> regions;
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) regions.push_back(static_cast<Region>(draw.below(3)));
    Folder folder;
    LocalExpression left;
    const cells::Folded folded = folder.fold(
        whole, [&](LeafId leaf) { return regions[leaf.get()]; }, left);
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<bool> inside;
      for (const Region region : regions) {
        inside.push_back(region == Region::inside || (region == Region::straddles && draw.one_in(2)));
      }
      ExpressionState oracle(compiled);
      oracle.reset();
      std::uint32_t first_owner = Owner::nobody;
      for (std::size_t i = 0; i < inside.size(); ++i) {
        if (inside[i]) oracle.flip(LeafId{i});
      }
      for (std::size_t i = inside.size(); i-- > 0;) {
        if (inside[i] && oracle.owns(LeafId{i})) first_owner = static_cast<std::uint32_t>(i);
      }
      const auto holds = [&](LeafId leaf) { return inside[leaf.get()]; };
      EXPECT_EQ(cells::evaluate(whole, holds).value, oracle.value());
      if (folded.constant) {
        EXPECT_EQ(folded.value, oracle.value());
        continue;
      }
      const cells::PointValue point = cells::evaluate(left, holds);
      ASSERT_EQ(point.value, oracle.value());
      if (point.value && point.owner.value != Owner::varies) {
        EXPECT_EQ(point.owner.value, first_owner);
      }
    }
  }
}

}  // namespace
}  // namespace tenon
