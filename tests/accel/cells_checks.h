#pragma once

#include "accel/battery.h"

/// What `cells` has to say in every scene, whoever makes it.
namespace tenon::cells_checks {

using fixtures::Draw;
using fixtures::SceneBuilder;

inline void expect_same_answers(const CsgTree& tree, const std::string& spec, int rounds = 60,
                                double least_hits = 0.1) {
  const auto none = build_accelerator("none", tree), judged = build_accelerator(spec, tree);
  ASSERT_TRUE(judged.ok()) << judged.error().message;
  const battery::Verdict verdict = battery::judge(**none, **judged, battery::make_rays(tree, **none, rounds, 31));
  EXPECT_EQ(verdict.mismatches, 0u) << spec << " of " << verdict.rays << " rays; the first:\n" << verdict.first;
  EXPECT_EQ(verdict.seam_faults, 0u);
  EXPECT_GT(static_cast<double>(verdict.hits), least_hits * static_cast<double>(verdict.rays));
}

inline double detail(const Accelerator& accelerator, std::string_view what) {
  for (const auto& one : accelerator.figures().details) {
    if (one.what == what) return one.value;
  }
  ADD_FAILURE() << "no figure is called " << what;
  return 0;
}

// Spheres that all touch one plane at the origin, from both sides: whatever contains that point straddles all.
inline CsgTree tangent_spheres(int count) {
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

struct Answers {
  std::vector<Hit> hits;
  std::vector<RayBoundary> boundaries;
  std::vector<std::uint8_t> occluded;
};

// All that may be asked of many rays at once.
inline Answers ask_together(const Accelerator& accelerator, std::span<const RayQuery> queries, TraceContext& context) {
  const std::size_t count = queries.size();
  Answers answers{std::vector<Hit>(count), std::vector<RayBoundary>(count), std::vector<std::uint8_t>(count)};
  accelerator.first_hits(queries, answers.hits, context);
  accelerator.first_boundaries(queries, answers.boundaries, context);
  accelerator.occluded(queries, answers.occluded, context);
  return answers;
}

// From what a ray has met to a light without extent.
inline RayQuery shadow_ray(const Hit& start, const Vec3& light) {
  RayQuery query;
  query.ray = {start.point, light - start.point};
  query.t_max = 1;
  query.kind = RayKind::shadow;
  query.from = &start;
  return query;
}

// Rays in all directions, which are followed several at once; from free space, from what they met, along
// axes, to an end, and from further off than single precision can tell.
inline void expect_streams_say_what_single_rays_say(const CsgTree& tree, int count) {
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

}  // namespace tenon::cells_checks
