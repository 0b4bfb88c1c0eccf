#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "support/scene_builder.h"

// What the battery does not ask of the grids and of RR-612's structures: filters by a view, sub-grids at every depth,
// and the scenes that would make a subdivision run away.
namespace tenon {
namespace {

using fixtures::SceneBuilder;
using fixtures::Tracer;

const char* const structures[] = {"grid", "nonuniform-grid", "space-tracing", "space-tracing-subgrids"};

SceneNodeId random_solid(SceneBuilder& b, std::mt19937_64& rng, int depth) {
  std::uniform_real_distribution<double> number(-1, 1);
  if (depth == 0) {
    const Vec3 at{2 * number(rng), 2 * number(rng), 2 * number(rng)};
    const double size = 0.5 + 0.4 * number(rng);
    SceneNodeId leaf = rng() % 2 == 0 ? b.sphere(size) : b.cube({size, 2 * size, 1}, true);
    if (rng() % 2 == 0) leaf = b.rotate(at * 40, leaf);
    return b.translate(at, leaf);
  }
  std::vector<SceneNodeId> operands;
  for (int i = 0; i < 3; ++i) operands.push_back(random_solid(b, rng, depth - 1));
  switch (rng() % 4) {
    case 0:
      return b.subtract(operands);
    case 1:
      return b.intersect({operands[0], b.unite({operands[1], b.complement(operands[2])})});
    default:
      return b.unite(operands);
  }
}

CsgTree random_tree(std::mt19937_64& rng) {
  SceneBuilder b;
  const SceneNodeId solid = b.unite({random_solid(b, rng, 3), random_solid(b, rng, 3)});
  // The complement of something is unbounded; a slab of it shows that it is there.
  return b.tree(rng() % 2 == 0 ? solid : b.intersect({b.complement(solid), b.cube({5, 5, 5}, true)}));
}

void expect_same(const Hit& hit, const Hit& oracle) {
  ASSERT_EQ(hit.found(), oracle.found());
  ASSERT_EQ(hit.t, oracle.t);
  ASSERT_EQ(hit.normal, oracle.normal);
  ASSERT_EQ(hit.surface, oracle.surface);
  ASSERT_EQ(hit.entering, oracle.entering);
}

ScreenView view_from(const Vec3& eye, bool orthographic) {
  ScreenView view;
  view.eye = eye;
  view.forward = normalize(Vec3{0.1, -0.2, 0.3} - eye);
  view.right = normalize(cross(view.forward, {0, 0, 1}));
  view.up = cross(view.right, view.forward);
  view.orthographic = orthographic;
  view.half_width = orthographic ? 3 : 0.6;
  view.width = 64;
  view.height = 48;
  return view;
}

Ray view_ray(const ScreenView& view, double x, double y) {
  const double scale = view.half_width / view.width;
  const Vec3 offset = ((2 * x - view.width) * scale) * view.right + ((view.height - 2 * y) * scale) * view.up;
  if (view.orthographic) return {view.eye + offset, view.forward};
  return {view.eye, view.forward + offset};
}

class InAView : public testing::TestWithParam<std::string> {};

TEST_P(InAView, PrimaryRaysAndRaysFromTheirHitsFindWhatNoneFinds) {
  std::mt19937_64 rng(43);
  std::uniform_real_distribution<double> number(-1, 1);
  std::size_t hits = 0;
  for (int round = 0; round < 12; ++round) {
    const CsgTree tree = random_tree(rng);
    // From outside, from among the solids, and from where the whole scene is behind the eye.
    const double distance = round % 3 == 0 ? 6 : round % 3 == 1 ? 0.8 : 40;
    const ScreenView view = view_from(Vec3{0.4, -0.8, 0.5} * distance, round % 2 == 0);
    auto built = build_accelerator(GetParam(), tree, &view);
    ASSERT_TRUE(built.ok());
    const auto context = (*built)->make_context();
    Tracer none(tree);
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        RayQuery query;
        query.ray = view_ray(view, x + 0.5 + 0.49 * number(rng), y + 0.5 + 0.49 * number(rng));
        query.pixel_x = x;
        query.pixel_y = y;
        const Hit hit = (*built)->first_hit(query, *context);
        expect_same(hit, none.first_hit(query.ray));
        if (HasFatalFailure()) return;
        if (!hit.found()) continue;
        ++hits;
        RayQuery second;
        second.kind = RayKind::reflected;
        second.ray = {hit.point, {number(rng), number(rng), number(rng)}};
        second.from = &hit;
        expect_same((*built)->first_hit(second, *context), none.first_hit(second.ray, &hit));
        if (HasFatalFailure()) return;
      }
    }
    EXPECT_EQ(context->statistics.seam_faults, 0u);
  }
  EXPECT_GT(hits, 3000u);
}

INSTANTIATE_TEST_SUITE_P(Specs, InAView,
                         testing::Values("space-tracing:levels=4", "space-tracing:axes=eye",
                                         "space-tracing-subgrids:axes=eye,levels=1,sublevels=3", "grid"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
                           return name;
                         });

// Rays of many kinds, compared with none's.
void compare(const CsgTree& tree, const std::string& spec, double size, int rays) {
  Tracer tracer(tree, spec), none(tree);
  std::mt19937_64 rng(17);
  std::uniform_real_distribution<double> number(-size, size);
  for (int i = 0; i < rays; ++i) {
    Ray ray{{number(rng), number(rng), number(rng)}, {number(rng), number(rng), number(rng)}};
    if (i % 3 == 0) ray.direction = {i % 2 == 0 ? size : 0, i % 2 == 0 ? 0 : -size, 0};
    expect_same(tracer.first_hit(ray), none.first_hit(ray));
    if (testing::Test::HasFatalFailure()) return;
    ASSERT_EQ(tracer.all_spans(ray), none.all_spans(ray));
  }
  EXPECT_EQ(tracer.statistics().seam_faults, 0u);
}

TEST(SpaceStructures, FindTheSameAtEveryDepthOfGridAndSubgrid) {
  std::mt19937_64 rng(6);
  for (int round = 0; round < 4; ++round) {
    const CsgTree tree = random_tree(rng);
    for (int levels = 0; levels <= 3; ++levels) {
      for (int sublevels = 0; sublevels <= 3; ++sublevels) {
        const std::string spec = "space-tracing-subgrids:primitives=1,levels=" + std::to_string(levels) +
                                 ",levels_y=2,sublevels=" + std::to_string(sublevels);
        compare(tree, spec, 4, 300);
      }
    }
  }
}

TEST(SpaceStructures, BearOnePrimitive) {
  SceneBuilder b;
  const CsgTree tree = b.tree(b.sphere(1));
  for (const char* name : structures) compare(tree, name, 2, 500);
}

TEST(SpaceStructures, BearAThousandPrimitivesInOnePlace) {
  SceneBuilder b;
  std::vector<SceneNodeId> spheres;
  for (int i = 0; i < 1000; ++i) spheres.push_back(b.sphere(1));
  const CsgTree tree = b.tree(b.unite(spheres));
  for (const char* name : structures) {
    compare(tree, name, 2, 50);
    EXPECT_LT(Tracer(tree, name).accelerator().figures().memory_bytes, std::size_t{1} << 25) << name;
  }
}

TEST(SpaceStructures, BearFlatScenes) {
  SceneBuilder b;
  std::vector<SceneNodeId> plates;
  for (int i = 0; i < 400; ++i) plates.push_back(b.translate({i % 20 * 1.0, i / 20 * 1.0, 0}, b.cube({1, 0.5, 1e-9})));
  const CsgTree tree = b.tree(b.unite(plates));
  for (const char* name : structures) compare(tree, name, 20, 500);
}

TEST(SpaceStructures, BearALopsidedTree) {
  SceneBuilder b;
  SceneNodeId chain = b.sphere(1);
  for (int i = 1; i < 3000; ++i) {
    const SceneNodeId sphere = b.translate({i % 50 * 1.0, i / 50 * 1.0, 0}, b.sphere(0.6));
    chain = i % 2 == 0 ? b.unite({chain, sphere}) : b.subtract({chain, sphere});
  }
  const CsgTree tree = b.tree(chain);
  for (const char* name : structures) compare(tree, name, 50, 30);
}

TEST(SpaceStructures, BearASceneThatIsOnlyHalfSpaces) {
  SceneBuilder b;
  const CsgTree tree = b.tree(b.complement(b.primitive("halfspace", {Vec3{0, 0, 1}, 0.5})));
  for (const char* name : structures) compare(tree, name, 2, 100);
}

TEST(SpaceStructures, SayWhatWouldTakeTooMuchMemory) {
  // Two cubes that touch in a corner: no level separates them.
  SceneBuilder b;
  const CsgTree tree = b.tree(b.unite({b.cube({1, 1, 1}), b.box({1, 1, 1}, {2, 2, 2})}));
  const char* const too_much[] = {"grid:resolution=1024", "nonuniform-grid:levels=10,primitives=1",
                                  "space-tracing:levels=10,primitives=1", "space-tracing-subgrids:levels=10"};
  for (const char* spec : too_much) {
    const auto built = build_accelerator(spec, tree);
    ASSERT_FALSE(built.ok()) << spec;
    EXPECT_EQ(built.error().kind, ErrorKind::usage);
    EXPECT_NE(built.error().message.find("more than"), std::string::npos) << built.error().message;
  }
}

}  // namespace
}  // namespace tenon
