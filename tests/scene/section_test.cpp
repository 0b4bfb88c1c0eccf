#include <gtest/gtest.h>

#include <algorithm>

#include "accel/random_solids.h"
#include "csg/csg_tree.h"
#include "support/scene_builder.h"
#include "tenon/scene/scene.h"

namespace tenon {
namespace {

using fixtures::Draw;
using fixtures::SceneBuilder;
using fixtures::Tracer;

struct Compiled {
  Scene scene;
  Diagnostics diagnostics;
};

Compiled compile(SceneGraph graph, std::vector<SectionCut> section, std::vector<Material> materials = {}) {
  Model model;
  model.graph = std::move(graph);
  model.section = std::move(section);
  model.materials = std::move(materials);
  Compiled compiled;
  Result<Scene> scene = compile_scene(std::move(model), compiled.diagnostics);
  EXPECT_TRUE(scene.ok()) << scene.error().message;
  compiled.scene = std::move(*scene);
  return compiled;
}

Material named(std::size_t i, double kt = 0, double priority = 0) {
  Material m;
  m.name = std::to_string(i);
  m.model = kt > 0 ? MaterialModel::whitted : MaterialModel::phong;
  m.kd = 1 - kt;
  m.ks = 0;
  m.kt = kt;
  m.priority = priority;
  return m;
}

// The stretches of a line that a cut leaves, by arithmetic alone: before and behind what lies beyond all its planes.
std::vector<SolidSpan> without(const SectionCut& cut, const Ray& ray, const std::vector<SolidSpan>& spans) {
  double from = 0, to = Box3::inf;
  for (const SectionPlane& plane : cut.planes) {
    const double slope = dot(plane.normal, ray.direction);
    const double t = (*plane.d - dot(plane.normal, ray.origin)) / slope;
    if (slope > 0) from = std::max(from, t);
    if (slope < 0) to = std::min(to, t);
  }
  if (from >= to) return spans;
  std::vector<SolidSpan> left;
  for (const SolidSpan& s : spans) {
    if (s.t_in < from) left.push_back({s.t_in, std::min(s.t_out, from)});
    if (s.t_out > to) left.push_back({std::max(s.t_in, to), s.t_out});
  }
  return left;
}

TEST(Section, LeavesWhatTheHalfSpacesLeave) {
  constexpr std::uint64_t seed = 71;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Draw draw(seed);
  std::size_t stretches = 0;
  for (int round = 0; round < 30; ++round) {
    const std::uint64_t solid_seed = seed * 1000 + static_cast<std::uint64_t>(round);
    const auto solid = [&] {
      Draw same(solid_seed);
      SceneBuilder b;
      std::vector<SceneNodeId> parts;
      for (int i = 0; i < 8; ++i)
        parts.push_back(fixtures::random_place(same, b, 1.5, fixtures::random_primitive(same, b, false)));
      const SceneNodeId root = fixtures::random_tree(same, b, parts);
      return b.finish(root);
    };
    std::vector<SectionCut> section(1 + static_cast<std::size_t>(draw.below(3)));
    for (SectionCut& cut : section) {
      for (int planes = 1 + draw.below(2); planes > 0; --planes) {
        cut.planes.push_back({draw.direction() * draw.real(0.1, 10), 0});
        cut.planes.back().d = draw.real(-0.5, 0.5) * length(cut.planes.back().normal);
      }
    }
    const Compiled whole = compile(solid(), {}), cut = compile(solid(), section);
    for (const char* spec : {"none", "cells", "multi-kd", "space-tracing"}) {
      Tracer whole_tracer(*whole.scene.tree), cut_tracer(*cut.scene.tree, spec);
      for (int i = 0; i < 120; ++i) {
        const Vec3 origin = 4 * draw.direction();
        const Ray ray{origin, draw.vector(-1, 1) - origin};
        std::vector<SolidSpan> expected = whole_tracer.all_spans(ray);
        for (const SectionCut& c : section) expected = without(c, ray, expected);
        const std::vector<SolidSpan> found = cut_tracer.all_spans(ray);
        ASSERT_EQ(found.size(), expected.size()) << "round " << round << ", " << spec;
        for (std::size_t k = 0; k < found.size(); ++k) {
          EXPECT_NEAR(found[k].t_in, expected[k].t_in, 1e-9);
          EXPECT_NEAR(found[k].t_out, expected[k].t_out, 1e-9);
        }
        stretches += found.size();
      }
      EXPECT_EQ(cut_tracer.statistics().seam_faults, 0u);
    }
  }
  EXPECT_GT(stretches, 500u) << "enough was met to tell";
}

// Overlapping balls, every other one hollow and some glass, one material each, against the test of a point.
TEST(Section, ACutFaceShowsWhoOwnsThePlace) {
  constexpr std::uint64_t seed = 72;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Draw draw(seed);
  for (const bool media : {false, true}) {
    for (const char* spec : {"none", "cells"}) {
      struct Part {
        Vec3 center;
        double r, hole, priority;
        bool holds(const Vec3& p) const { return length(p - center) <= r && length(p - center) >= hole; }
      };
      std::vector<Part> parts;
      std::vector<Material> materials;
      SceneBuilder b;
      std::vector<SceneNodeId> nodes;
      for (std::size_t i = 0; i < 14; ++i) {
        const double r = draw.real(0.4, 1);
        parts.push_back({draw.vector(-1, 1), r, i % 2 == 0 ? 0.6 * r : 0, media && i % 5 == 0 ? 1.0 : 0.0});
        materials.push_back(named(i, media && i % 3 == 0 ? 0.9 : 0, parts.back().priority));
        const SceneNodeId ball = b.sphere(r);
        const SceneNodeId part = i % 2 == 0 ? b.subtract({ball, b.sphere(0.6 * r)}) : ball;
        nodes.push_back(b.material(i, b.translate(parts.back().center, part)));
      }
      const Vec3 normal = draw.direction();
      const Compiled compiled = compile(b.finish(b.unite(nodes)), {{{{normal, 0.1}}}}, materials);
      Tracer tracer(*compiled.scene.tree, spec);
      int faces = 0;
      for (int i = 0; i < 2000; ++i) {
        // Against the plane from its free side.
        Vec3 at = draw.vector(-1.5, 1.5);
        at += (0.1 - dot(at, normal)) * normal;
        const Hit hit = tracer.first_hit({at + 5.0 * normal, -normal});
        const Part* owner = nullptr;
        for (const Part& part : parts) {
          if (part.holds(at) && (owner == nullptr || part.priority > owner->priority)) owner = &part;
        }
        if (owner == nullptr) {
          EXPECT_TRUE(!hit.found() || hit.t > 5 + 1e-9);
          continue;
        }
        ASSERT_TRUE(hit.found());
        EXPECT_NEAR(hit.t, 5, 1e-9);
        EXPECT_GE(hit.surface.leaf, compiled.scene.first_section_plane);
        EXPECT_NEAR(length(hit.normal - normal), 0, 1e-12) << "out of the solid";
        EXPECT_EQ(compiled.scene.material(hit.material).name, std::to_string(owner - parts.data()));
        ++faces;
      }
      EXPECT_GT(faces, 500);
    }
  }
}

// Two boxes of a size, one on the other, in a frame of their own.
struct Stack {
  double scale;
  Vec3 degrees;

  Affine3 map() const { return Affine3::translate(offset()) * Affine3::rotate(degrees); }
  Vec3 offset() const { return scale * Vec3{30, -20, 10}; }
  Vec3 up() const { return map().direction({0, 0, 1}); }
  SceneGraph graph() const {
    SceneBuilder b;
    const SceneNodeId lower = b.material(0, b.cube({scale, scale, scale}));
    const SceneNodeId upper = b.material(1, b.box({0, 0, scale}, {scale, scale, 2 * scale}));
    return b.finish(b.translate(offset(), b.rotate(degrees, b.unite({lower, upper}))));
  }
  // Takes away what lies above a height, or below it where `side` is -1.
  std::vector<SectionCut> cut_at(double height, double side) const {
    return {{{{side * up(), side * dot(up(), map().point({0, 0, height * scale}))}}}};
  }
};

// A plane in a face of the solid, turned and moved: the outer side takes nothing away, the inner everything, and where
// two parts touch in it the face of the part that stays is seen.
TEST(Section, PlanesInFacesAreClean) {
  struct Case {
    double height, side;
    int shown;        // the material seen from beyond the plane; -1: nothing
    double expected;  // where it is met, from 5 above or below the stack's middle
  };
  for (const Stack& stack : {Stack{1, {}}, Stack{1e6, {12.7, 48.1, 77.7}}, Stack{1e-6, {5, 3, 11}}}) {
    for (const Case& c : {Case{2, 1, 1, 4}, Case{2, -1, -1, 0}, Case{0, -1, 0, 4}, Case{0, 1, -1, 0}, Case{1, 1, 0, 5},
                          Case{1, -1, 1, 5}}) {
      const Compiled compiled = compile(stack.graph(), stack.cut_at(c.height, c.side), {named(0), named(1)});
      for (const std::string_view spec : accelerator_names()) {
        Tracer tracer(*compiled.scene.tree, spec);
        for (int i = 0; i < 49; ++i) {
          const Vec3 at{(i % 7 + 0.531) / 7, (i / 7 + 0.447) / 7, 1 + 5 * c.side};
          const Hit hit = tracer.first_hit({stack.map().point(stack.scale * at), -c.side * stack.up()});
          ASSERT_EQ(hit.found(), c.shown >= 0) << spec << ", cut at " << c.height << ", side " << c.side;
          if (!hit.found()) continue;
          EXPECT_NEAR(hit.t, c.expected * stack.scale, 1e-9 * stack.scale);
          EXPECT_EQ(compiled.scene.material(hit.material).name, std::to_string(c.shown)) << spec;
          EXPECT_LT(hit.surface.leaf, compiled.scene.first_section_plane) << "a face, not a cut face";
        }
      }
    }
  }
}

TEST(Section, APlaneWithoutADistanceGoesThroughTheMiddleOfTheSolid) {
  // The solid reaches from 1 to 3 along x: its primitives reach much farther.
  SceneBuilder b;
  const SceneNodeId solid = b.intersect({b.box({-9, -9, -9}, {3, 9, 9}), b.box({1, -1, -1}, {30, 1, 1})});
  const Compiled compiled = compile(b.finish(solid), {{{{{1, 0, 0}, std::nullopt}}}});
  Tracer tracer(*compiled.scene.tree);
  const Hit hit = tracer.first_hit({{50, 0, 0}, {-1, 0, 0}});
  EXPECT_NEAR(50 - hit.t, 2, 0.01);
}

TEST(Section, SaysThatNothingIsLeft) {
  SceneBuilder b;
  Compiled compiled = compile(b.finish(b.sphere(1)), {{{{{0, 0, 1}, -2}}}});
  ASSERT_EQ(compiled.diagnostics.warnings().size(), 1u);
  EXPECT_NE(compiled.diagnostics.warnings()[0].find("nothing is left"), std::string::npos);
  SceneBuilder other;
  EXPECT_TRUE(compile(other.finish(other.sphere(1)), {{{{{0, 0, 1}, 0}}}}).diagnostics.warnings().empty());
}

TEST(Section, AViewThatNobodyChoseShowsTheCutFaces) {
  for (const Vec3 normal : {Vec3{0, -1, 0}, Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1},
                            Vec3{1, 1, 0}, Vec3{-1, 2, -1}}) {
    SceneBuilder b;
    const Compiled compiled = compile(b.finish(b.cube({2, 2, 2}, true)), {{{{normal, 0}}}});
    const Camera& camera = compiled.scene.camera;
    EXPECT_GT(dot(normalize(camera.from - camera.at), normalize(normal)), 0.45);
  }
}

}  // namespace
}  // namespace tenon
