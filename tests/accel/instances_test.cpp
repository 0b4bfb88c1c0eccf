#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "accel/gallery.h"
#include "csg/prototype.h"

namespace tenon {
namespace {

using fixtures::Draw;
using fixtures::SceneBuilder;
using fixtures::Tracer;

std::size_t leaves_with_prototypes(const CsgTree& tree) {
  std::size_t leaves = tree.leaves.size();
  for (const auto& prototype : tree.prototypes) leaves += leaves_with_prototypes(prototype->tree());
  return leaves;
}

// The boundaries a ray meets, one by one, each from the one before.
std::vector<Hit> all_hits(Tracer& tracer, const Ray& ray) {
  std::vector<Hit> hits;
  Ray from = ray;
  double t = 0;
  for (Hit hit = tracer.first_hit(from); hit.found() && hits.size() < 100;) {
    t += hit.t;
    const Hit start = hit;
    hit.t = t;
    hits.push_back(hit);
    from.origin = start.point;
    hit = tracer.first_hit(from, &start);
  }
  return hits;
}

// A scene that stores what repeats once must look like the one spelled out. Where rounding decides, what two rays in a
// thousand may meet, the number of boundaries may differ.
TEST(Instances, LookLikeWhatTheyStandFor) {
  std::size_t rays = 0, boundaries = 0, differ = 0;
  for (std::uint64_t seed = 21; seed < 33; ++seed) {
    SceneBuilder once, whole;
    const CsgTree stored = once.instanced_tree(gallery::repeated_node(once, seed));
    const CsgTree spelled = whole.tree(gallery::repeated_node(whole, seed));
    ASSERT_FALSE(stored.prototypes.empty()) << "seed " << seed;
    ASSERT_LT(leaves_with_prototypes(stored), spelled.leaves.size());
    Tracer a(stored), b(spelled);
    Draw draw(seed);
    for (int i = 0; i < 2000; ++i, ++rays) {
      const Vec3 from = Vec3{4, 0, 1} + 20 * draw.direction(),
                 aim{draw.real(-5, 13), draw.real(-5, 5), draw.real(-4, 4)};
      const Ray ray{from, normalize(aim - from)};
      const std::vector<Hit> got = all_hits(a, ray), expected = all_hits(b, ray);
      if (got.size() != expected.size()) {
        ++differ;
        continue;
      }
      for (std::size_t k = 0; k < got.size(); ++k, ++boundaries) {
        // Each step of the way adds the rounding of its point to both.
        const double bound = (got[k].bound + expected[k].bound + 1e-12) * static_cast<double>(k + 1);
        EXPECT_NEAR(got[k].t, expected[k].t, bound) << "seed " << seed << " ray " << i << " boundary " << k;
        EXPECT_EQ(got[k].entering, expected[k].entering);
        EXPECT_EQ(got[k].material, expected[k].material) << "seed " << seed << " ray " << i << " boundary " << k;
        const double turned = 1 - dot(got[k].normal, expected[k].normal);
        EXPECT_LT(turned, 1e-6) << "seed " << seed << " ray " << i << " boundary " << k;
      }
    }
  }
  EXPECT_GT(boundaries, rays / 2) << "the rays miss";
  EXPECT_LE(differ, rays / 500);
}

// The tool's own colour, the base's colour on the face of a tool without one, and the colour given from outside.
TEST(Instances, KeepTheirMaterials) {
  SceneBuilder b;
  const SceneNodeId two_coloured =
      b.subtract({b.material(1, b.cube({2, 2, 2})), b.translate({1, 1, 1}, b.cube({2, 2, 2})),
                  b.material(2, b.translate({-1, -1, 1}, b.cube({2, 2, 2}))),
                  b.translate({0.5, 0.5, -1}, b.cube({0.25, 0.25, 0.5}))});
  const SceneNodeId plain = b.subtract({b.cube({2, 2, 2}), b.cube({1, 1, 1}), b.cylinder(3, 0.1), b.sphere(0.5)});
  const CsgTree tree = b.instanced_tree(
      b.unite({two_coloured, b.translate({10, 0, 0}, two_coloured), b.material(3, b.translate({20, 0, 0}, plain)),
               b.material(4, b.translate({30, 0, 0}, plain)),
               b.subtract({b.translate({40, 0, 0}, two_coloured), b.translate({41.75, 0, 0}, b.cube({2, 2, 2}))})}));
  EXPECT_EQ(tree.prototypes.size(), 2u);
  EXPECT_EQ(tree.leaves.size(), 6u);
  Tracer tracer(tree);
  const auto seen = [&](const Vec3& from, const Vec3& towards) { return tracer.first_hit({from, towards}).material; };
  for (const double x : {0.0, 10.0, 40.0}) {
    EXPECT_EQ(seen({x + 1.5, 1.5, 5}, {0, 0, -1}), MaterialId{1}) << "a face cut by a tool without a material";
    EXPECT_EQ(seen({x + 0.5, 0.5, 5}, {0, 0, -1}), MaterialId{2}) << "a face cut by a tool with one";
    EXPECT_EQ(seen({x + 0.5, 1.5, 5}, {0, 0, -1}), MaterialId{1});
  }
  EXPECT_EQ(seen({45, 0.5, 0.5}, {-1, 0, 0}), MaterialId{1}) << "what cuts the instance from outside";
  EXPECT_EQ(seen({21.5, 1.5, 5}, {0, 0, -1}), MaterialId{3});
  EXPECT_EQ(seen({31.5, 1.5, 5}, {0, 0, -1}), MaterialId{4});
  EXPECT_EQ(seen({30.5, 0.5, -5}, {0, 0, 1}), MaterialId{4}) << "within the cut";
}

TEST(Instances, ScenesThatRepeatThemselvesStaySmall) {
  SceneBuilder b;
  SceneNodeId node = b.subtract({b.cube({1, 1, 1}), b.sphere(0.5), b.cylinder(1, 0.2), b.torus(0.5, 0.1)});
  for (int level = 0; level < 20; ++level) {
    const double step = std::ldexp(1.0, level);
    node = b.unite({node, b.translate({step, 0, 0}, node), b.translate({0, step, 0}, node)});
  }
  Diagnostics diagnostics;
  const SceneGraph graph = b.finish(node);
  EXPECT_LT(graph.nodes.size(), 100u);
  const InstancePlan plan = plan_instances(graph, {}, 1000);
  const CsgTree tree = push_attributes(graph, diagnostics, plan);
  EXPECT_LT(leaves_with_prototypes(tree), 10000u) << "of 14 thousand million";
  // A Sierpinski triangle, a million to a side, seen from one of its corners.
  Tracer tracer(tree);
  const Hit hit = tracer.first_hit({{-5, 0.9, 0.25}, {1, 0, 0}});
  ASSERT_TRUE(hit.found());
  EXPECT_NEAR(hit.t, 5, 1e-6);
}

TEST(Instances, GraphsHoldWhatIsTheSameOnce) {
  SceneBuilder b;
  const auto part = [&](double r) { return b.subtract({b.cube({1, 1, 1}), b.translate({0.5, 0, 0}, b.sphere(r))}); };
  EXPECT_EQ(part(0.25), part(0.25));
  EXPECT_NE(part(0.25), part(0.5));
  const Outline square{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
  EXPECT_EQ(b.primitive("prism", {square, 1.0, false, 1.0}), b.primitive("prism", {square, 1.0, false, 1.0}));
  EXPECT_NE(b.primitive("prism", {square, 1.0, false, 1.0}), b.primitive("prism", {square, 1.0, true, 1.0}));
  const auto ball = [&](double r) {
    return b.primitive("mesh", {meshes::share(meshes::star(1, [r](const Vec3&) { return r; })), false});
  };
  EXPECT_EQ(ball(1), ball(1)) << "two meshes with the same triangles";
  EXPECT_NE(ball(1), ball(1.5));
}

}  // namespace
}  // namespace tenon
