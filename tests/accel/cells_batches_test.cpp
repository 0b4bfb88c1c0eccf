#include "accel/cells_checks.h"
#include "support/instruction_sets.h"

/// Many rays at once, which have to say what they say one by one.

namespace tenon {
namespace {

using fixtures::Draw;
using fixtures::SceneBuilder;
using namespace cells_checks;

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

struct PictureHits {
  std::size_t found = 0;
  std::size_t with_several_faces = 0;
};

// Rays of one picture, which are traced many at a time.
PictureHits expect_packets_say_what_single_rays_say(const CsgTree& tree) {
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
  PictureHits counts;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const Hit hit = (*none)->first_hit(queries[i], *context);
    counts.found += hit.found();
    counts.with_several_faces += hit.faces.size() > 1;
    EXPECT_TRUE(battery::same_hit(hit, hits[i])) << battery::describe(hit) << " against " << battery::describe(hits[i]);
    if (testing::Test::HasFailure()) break;
  }
  return counts;
}

TEST(Cells, PacketsSayWhatSingleRaysSay) {
  EXPECT_GT(expect_packets_say_what_single_rays_say(gallery::random_scene(5, 24, 1.5)).found, 1000U);
}

// Faces that coincide are told for many rays together, too: all of them, in the order of the leaves.
TEST(Cells, PacketsTellFacesThatCoincide) {
  std::size_t with_several_faces = 0;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    const PictureHits hits = expect_packets_say_what_single_rays_say(gallery::lattice_scene(seed, {}));
    EXPECT_GT(hits.found, 400U);
    with_several_faces += hits.with_several_faces;
  }
  EXPECT_GT(with_several_faces, 1000U);
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
    ASSERT_EQ(boundaries[i].entering, hit.found() && hit.entering);
    ASSERT_EQ(occluded[i] != 0, hit.found());
  }
  EXPECT_GT(found, queries.size() / 4);
  EXPECT_LT(found, queries.size());
  // What lies at the end of a ray does not count.
  for (std::size_t i = 0; i < queries.size(); ++i) {
    if (hits[i].found()) queries[i].t_max = hits[i].t;
  }
  const auto at_end = ask_together(**judged, queries, *other);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    ASSERT_FALSE(at_end.hits[i].found());
    ASSERT_FALSE(at_end.boundaries[i].found());
    ASSERT_FALSE(at_end.boundaries[i].entering);
    ASSERT_EQ(at_end.occluded[i], 0);
  }
}

// Shadow rays as a picture has them: those to one light after those to another, in runs of any length. Where runs are
// long, a batch ends with each.
TEST(Cells, RunsOfRaysToSeveralLightsSayWhatSingleRaysSay) {
  const CsgTree tree = gallery::random_scene(5, 24, 1.5);
  const auto none = build_accelerator("none", tree), judged = build_accelerator("cells", tree);
  const auto context = (*none)->make_context(), other = (*judged)->make_context();
  const Box3 box = battery::extent(tree);
  Draw draw(41);
  std::vector<Hit> starts;
  for (int i = 0; i < 400; ++i) {
    RayQuery query;
    query.ray = {box.center() + length(box.size()) * draw.direction(), {}};
    query.ray.direction = draw.in_box(box) - query.ray.origin;
    if (const Hit hit = (*none)->first_hit(query, *context); hit.found()) starts.push_back(hit);
  }
  ASSERT_GT(starts.size(), 100u);
  std::vector<RayQuery> queries;
  while (queries.size() < 4000) {
    const Vec3 light = box.center() + 3 * length(box.size()) * draw.direction();
    const auto run = static_cast<std::size_t>(draw.real(0, 2) < 1 ? draw.real(1, 8) : draw.real(8, 150));
    const auto first = static_cast<std::size_t>(draw.real(0, static_cast<double>(starts.size())));
    for (std::size_t i = 0; i < run; ++i) {
      queries.push_back(shadow_ray(starts[(first + i) % starts.size()], light));
    }
  }
  std::size_t found = 0;
  for (std::size_t begin = 0; begin < queries.size();) {
    const auto call = std::min(queries.size() - begin, static_cast<std::size_t>(draw.real(1, 500)));
    const std::span<const RayQuery> asked = std::span(queries).subspan(begin, call);
    const auto [hits, boundaries, occluded] = ask_together(**judged, asked, *other);
    for (std::size_t i = 0; i < call; ++i) {
      const Hit hit = (*none)->first_hit(asked[i], *context);
      found += hit.found();
      ASSERT_TRUE(battery::same_hit(hit, hits[i]))
          << battery::describe(hit) << " against " << battery::describe(hits[i]);
      ASSERT_EQ(boundaries[i].t, hit.t);
      ASSERT_EQ(occluded[i] != 0, hit.found());
    }
    begin += call;
  }
  EXPECT_GT(found, queries.size() / 8);
  EXPECT_LT(found, queries.size());
}

}  // namespace
}  // namespace tenon
