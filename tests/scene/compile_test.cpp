#include <gtest/gtest.h>

#include <cmath>

#include "csg/csg_tree.h"
#include "support/scene_builder.h"
#include "tenon/scene/scene.h"

namespace tenon {
namespace {

using fixtures::SceneBuilder;

Material named(const char* name, double kt = 0) {
  Material m;
  m.name = name;
  m.model = kt > 0 ? MaterialModel::whitted : MaterialModel::phong;
  m.kd = 1 - kt;
  m.ks = 0;
  m.kt = kt;
  return m;
}

Scene compile(SceneBuilder& b, SceneNodeId root, std::vector<Material> materials = {}) {
  Model model;
  model.graph = b.finish(root);
  model.materials = std::move(materials);
  Diagnostics diagnostics;
  Result<Scene> scene = compile_scene(std::move(model), diagnostics);
  EXPECT_TRUE(scene.ok());
  return std::move(scene).value();
}

std::string material_of(const Scene& scene, std::size_t leaf) {
  return scene.material(scene.tree->leaves[leaf].material).name;
}

TEST(CompileScene, RefusesASceneWithoutSolids) {
  SceneBuilder b;
  Model model;
  model.graph = b.finish(b.unite({}));
  Diagnostics diagnostics;
  const Result<Scene> scene = compile_scene(std::move(model), diagnostics);
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().kind, ErrorKind::input);
}

TEST(CompileScene, SaysThatOperationsLeaveNothing) {
  for (const bool apart : {true, false}) {
    SceneBuilder b;
    Model model;
    const SceneNodeId ball = b.sphere(1), other = b.translate({apart ? 5.0 : 0.5, 0, 0}, b.sphere(1));
    model.graph = b.finish(b.intersect({ball, other}));
    Diagnostics diagnostics;
    const Result<Scene> scene = compile_scene(std::move(model), diagnostics);
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(diagnostics.warnings().size(), apart ? 1u : 0u);
    EXPECT_TRUE(std::isfinite(length(scene->camera.from))) << "something to look from";
    EXPECT_NE(scene->camera.from, scene->camera.at);
  }
}

TEST(CompileScene, TheNearestMaterialApplies) {
  SceneBuilder b;
  const SceneNodeId inner = b.material(1, b.sphere(1));
  const Scene scene = compile(b, b.material(0, b.unite({inner, b.cube({1, 1, 1})})), {named("outer"), named("inner")});
  EXPECT_EQ(material_of(scene, 0), "inner");
  EXPECT_EQ(material_of(scene, 1), "outer");
}

TEST(CompileScene, TheOutermostColorApplies) {
  SceneBuilder b;
  const Rgba red{1, 0, 0, 1}, blue{0, 0, 1, 1};
  const Scene scene = compile(b, b.color(red, b.color(blue, b.sphere(1))));
  EXPECT_EQ(scene.material(scene.tree->leaves[0].material).color, red);
}

TEST(CompileScene, AMaterialsOwnColourStandsAndAColorFillsInWhereItHasNone) {
  SceneBuilder b;
  const Rgba red{1, 0, 0, 1}, blue{0, 0, 1, 1};
  Material tinted = named("tinted");
  tinted.color = blue;
  const SceneNodeId both = b.unite({b.material(0, b.sphere(1)), b.material(1, b.sphere(2))});
  const Scene scene = compile(b, b.color(red, both), {tinted, named("plain")});
  EXPECT_EQ(scene.material(scene.tree->leaves[0].material).color, blue);
  EXPECT_EQ(scene.material(scene.tree->leaves[1].material).color, red);
  EXPECT_EQ(material_of(scene, 1), "plain");
}

TEST(CompileScene, AnOpacityLetsLightThrough) {
  SceneBuilder b;
  const Scene scene = compile(b, b.color({1, 0, 0, 0.25}, b.sphere(1)));
  const Material& m = scene.material(scene.tree->leaves[0].material);
  EXPECT_DOUBLE_EQ(m.kt, 0.75);
  EXPECT_DOUBLE_EQ(m.kd, 0.25);
  EXPECT_TRUE(scene.tree->has_media);
}

TEST(CompileScene, SolidsOfOneTransparentMaterialAreOneMedium) {
  SceneBuilder b;
  const Scene scene = compile(
      b, b.unite({b.material(0, b.sphere(1)), b.material(1, b.sphere(2)), b.material(0, b.sphere(3)), b.sphere(4)}),
      {named("glass", 0.9), named("water", 0.8)});
  const auto& leaves = scene.tree->leaves;
  EXPECT_EQ(leaves[0].medium, leaves[2].medium);
  EXPECT_NE(leaves[0].medium, leaves[1].medium);
  EXPECT_EQ(leaves[3].medium, medium_opaque);
  EXPECT_EQ(scene.media.size(), 4u);
}

TEST(CompileScene, APhongMaterialIsOpaqueWhateverItsTransmission) {
  SceneBuilder b;
  Material m = named("odd", 0.5);
  m.model = MaterialModel::phong;
  EXPECT_FALSE(compile(b, b.material(0, b.sphere(1)), {m}).tree->has_media);
}

TEST(CompileScene, BehindGlassThatTouchesItTheOpaqueSolidIsSeen) {
  // Whichever of the two stands first in the file.
  for (const bool glass_first : {true, false}) {
    SceneBuilder b;
    const SceneNodeId glass = b.material(0, b.box({0, 0, 1}, {2, 2, 2}));
    const SceneNodeId wall = b.material(1, b.cube({2, 2, 1}));
    const Scene scene = compile(b, b.unite(glass_first ? std::vector{glass, wall} : std::vector{wall, glass}),
                                {named("glass", 0.9), named("wall")});
    fixtures::Tracer tracer(*scene.tree);
    const Hit front = tracer.first_hit({{1, 1, 5}, {0, 0, -1}});
    EXPECT_EQ(scene.material(front.material).name, "glass");
    const Hit back = tracer.first_hit({front.point, {0, 0, -1}}, &front);
    EXPECT_DOUBLE_EQ(back.t, 1);
    EXPECT_EQ(scene.material(back.material).name, "wall");
    EXPECT_EQ(back.normal, (Vec3{0, 0, 1}));
  }
}

TEST(CompileScene, ACutFaceShowsTheToolsMaterialOnlyIfItHasOne) {
  const auto cut_face = [](bool tool_has_material) {
    SceneBuilder b;
    const SceneNodeId base = b.material(0, b.cube({2, 2, 2}));
    const SceneNodeId tool = b.box({0.5, 0.5, 1}, {1.5, 1.5, 3});
    const SceneNodeId cut = b.subtract({base, tool_has_material ? b.material(1, tool) : tool});
    const Scene scene = compile(b, cut, {named("base"), named("tool")});
    fixtures::Tracer tracer(*scene.tree);
    const Hit hit = tracer.first_hit({{1, 1, 5}, {0, 0, -1}});
    EXPECT_DOUBLE_EQ(hit.t, 4);
    EXPECT_EQ(hit.normal, (Vec3{0, 0, 1})) << "out of the solid, whatever the tool's own is";
    EXPECT_TRUE(hit.entering);
    return scene.material(hit.material).name;
  };
  EXPECT_EQ(cut_face(true), "tool");
  EXPECT_EQ(cut_face(false), "base");
}

TEST(CompileScene, ACutFaceShowsTheBaseWhereItIsAskedTo) {
  // Two bases side by side, one tool through both; the nearest attribute counts, and only for what is subtracted.
  const auto shown = [](const char* spec, std::optional<CutFaces> around, std::optional<CutFaces> at_tool) {
    SceneBuilder b;
    const SceneNodeId bases = b.unite({b.material(0, b.cube({2, 2, 2})), b.material(1, b.box({2, 0, 0}, {4, 2, 2}))});
    SceneNodeId tool = b.material(2, b.box({0.5, 0.5, 1}, {3.5, 1.5, 3}));
    if (at_tool) tool = b.cut_faces(*at_tool, tool);
    SceneNodeId solid = b.subtract({bases, tool});
    if (around) solid = b.cut_faces(*around, solid);
    const Scene scene = compile(b, solid, {named("left"), named("right"), named("tool")});
    fixtures::Tracer tracer(*scene.tree, spec);
    std::string all;
    for (const double x : {1.0, 3.0}) {
      all += scene.material(tracer.first_hit({{x, 1, 5}, {0, 0, -1}}).material).name + ' ';
    }
    // Beside the cut the base's own face.
    return all + scene.material(tracer.first_hit({{0.2, 1, 5}, {0, 0, -1}}).material).name;
  };
  for (const char* spec : {"none", "cells", "okd"}) {
    EXPECT_EQ(shown(spec, {}, {}), "tool tool left");
    EXPECT_EQ(shown(spec, CutFaces::base, {}), "left right left");
    EXPECT_EQ(shown(spec, {}, CutFaces::base), "left right left");
    EXPECT_EQ(shown(spec, CutFaces::base, CutFaces::tool), "tool tool left");
    EXPECT_EQ(shown(spec, CutFaces::tool, CutFaces::base), "left right left");
  }
}

// A sharpener is all but a cone: the faces that it leaves are the cone's, which it does not hold.
TEST(CompileScene, WhatIsTakenOutOfAToolIsPartOfIt) {
  for (const CutFaces show : {CutFaces::tool, CutFaces::base}) {
    SceneBuilder b;
    const SceneNodeId base = b.material(0, b.cube({2, 2, 2}, true));
    const SceneNodeId tool = b.material(1, b.subtract({b.cube({9, 9, 9}, true), b.sphere(1.2)}));
    const Scene scene = compile(b, b.cut_faces(show, b.subtract({base, tool})), {named("base"), named("tool")});
    fixtures::Tracer tracer(*scene.tree, "cells");
    const Hit rounded = tracer.first_hit({{5, 5, 5}, {-1, -1, -1}});
    EXPECT_NEAR(length(rounded.point), 1.2, 1e-9);
    EXPECT_EQ(scene.material(rounded.material).name, show == CutFaces::base ? "base" : "tool");
  }
}

TEST(SceneFigures, CountsWhatWasModelled) {
  SceneBuilder b;
  const Scene scene = compile(b, b.subtract({b.cube({2, 2, 2}), b.unite({b.sphere(1), b.sphere(0.5)})}));
  const SceneFigures figures = scene_figures(scene);
  EXPECT_EQ(figures.primitives, 3u);
  EXPECT_EQ(figures.operations, 2u);
  EXPECT_EQ(figures.depth, 3);
  ASSERT_EQ(figures.primitives_by_kind.size(), 2u);
  EXPECT_EQ(figures.bounds, (Box3{{0, 0, 0}, {2, 2, 2}})) << "what a person wrote, without rounding";
}

}  // namespace
}  // namespace tenon
