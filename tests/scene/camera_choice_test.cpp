#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "accel/random_solids.h"
#include "csg/csg_tree.h"
#include "scene/solid_extent.h"
#include "support/scene_builder.h"
#include "tenon/scene/scene.h"

namespace tenon {
namespace {

using fixtures::Draw;
using fixtures::SceneBuilder;
using fixtures::Tracer;

Scene compile(SceneGraph graph, const ViewRequest& view, const std::optional<Camera>& camera = {}) {
  Model model;
  model.graph = std::move(graph);
  model.camera = camera;
  Diagnostics diagnostics;
  Result<Scene> scene = compile_scene(std::move(model), diagnostics, view);
  EXPECT_TRUE(scene.ok());
  return std::move(*scene);
}

double support(SceneBuilder& b, SceneNodeId root, const Vec3& n) {
  const CsgTree tree = b.tree(root);
  return SolidExtent(tree).support(n);
}

TEST(SolidExtent, OfSolidsWithAFormula) {
  const double tolerance = 0.004;  // a thousandth of the largest of them
  const Vec3 n = normalize(Vec3{1, 2, -2});
  {
    SceneBuilder b;
    EXPECT_NEAR(support(b, b.translate({1, 1, 1}, b.sphere(2)), 3.0 * n), 6 + 1, tolerance);
  }
  {
    // A lens of two balls: its rim lies where they meet, a height of sqrt(3)/2 from the axis.
    SceneBuilder b;
    const SceneNodeId lens =
        b.intersect({b.translate({0.5, 0, 0}, b.sphere(1)), b.translate({-0.5, 0, 0}, b.sphere(1))});
    const SceneNodeId turned = b.rotate({10, 20, 30}, lens);
    const Affine3 map = Affine3::rotate({10, 20, 30});
    const CsgTree tree = b.tree(turned);
    SolidExtent extent(tree);
    EXPECT_NEAR(extent.support(map.direction({1, 0, 0})), 0.5, tolerance);
    EXPECT_NEAR(extent.support(map.direction({0, 1, 0})), std::sqrt(3.0) / 2, tolerance);
  }
  {
    // A cube without the corner that reaches farthest: its cut goes through three other corners.
    SceneBuilder b;
    const SceneNodeId cut = b.subtract({b.cube({1, 1, 1}), b.primitive("halfspace", {Vec3{-1, -1, -1}, -2.0})});
    const double found = support(b, cut, {1, 1, 1});
    EXPECT_GE(found, 2);
    EXPECT_LT(found, 2.02) << "a face askew";
  }
  {
    SceneBuilder b;
    EXPECT_EQ(support(b, b.subtract({b.cube({1, 1, 1}), b.sphere(9)}), n), -Box3::inf) << "nothing is left";
  }
}

TEST(SolidExtent, NoPointLiesBeyondItAndSomePointNearIt) {
  constexpr std::uint64_t seed = 73;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Draw draw(seed);
  for (int round = 0; round < 8; ++round) {
    SceneBuilder b;
    std::vector<SceneNodeId> parts;
    for (int i = 0; i < 6; ++i)
      parts.push_back(fixtures::random_place(draw, b, 1, fixtures::random_primitive(draw, b, false)));
    const CsgTree tree = b.tree(fixtures::random_tree(draw, b, parts));
    SolidExtent extent(tree);
    Tracer tracer(tree, "cells");
    const Vec3 n = draw.direction();
    double farthest = -Box3::inf;
    for (int i = 0; i < 20000; ++i) {
      const Hit hit = tracer.first_hit({draw.in_box(extent.enclosure()) + 9.0 * n, -n});
      if (hit.found()) farthest = std::max(farthest, dot(n, hit.point));
    }
    const double found = extent.support(n);
    EXPECT_LE(farthest, found + 1e-9);
    // Rays pass spikes by; most solids have none.
    EXPECT_LT(found - farthest, 0.15 * max_component(extent.enclosure().size())) << "round " << round;
  }
}

// Where a point lies in the picture: within -1 and 1 both ways.
std::pair<double, double> project(const Camera& camera, double aspect, const Vec3& p) {
  const Vec3 forward = normalize(camera.at - camera.from), right = normalize(cross(forward, camera.up)),
             up = cross(right, forward);
  const Vec3 v = p - camera.from;
  const double half = camera.projection == Projection::orthographic
                          ? camera.width / 2
                          : dot(v, forward) * std::tan(camera.fov * std::numbers::pi / 360);
  EXPECT_GT(half, 0);
  return {dot(v, right) / half, dot(v, up) / half * aspect};
}

TEST(FitCamera, TheSolidFillsThePictureButForAMargin) {
  constexpr std::uint64_t seed = 74;
  SCOPED_TRACE("seed " + std::to_string(seed));
  Draw draw(seed);
  for (int round = 0; round < 16; ++round) {
    const bool orthographic = round % 2 == 1;
    const double aspect = draw.real(0.4, 2.5);
    // Corners that are known: of a box turned anyhow, with its middle taken out and a rod that the cut leaves nothing
    // of.
    const Vec3 size = draw.vector(0.2, 2), degrees = draw.vector(-180, 180), offset = draw.vector(-20, 20);
    SceneBuilder b;
    const SceneNodeId box =
        b.subtract({b.unite({b.cube(size, true), b.cylinder(9, 0.05, true)}), b.cylinder(30, 0.3, true)});
    ViewRequest view;
    view.fit = true;
    view.orthographic = orthographic;
    view.aspect = aspect;
    view.angles = ViewAngles{draw.real(-180, 180), draw.real(-90, 90)};
    const Scene scene = compile(b.finish(b.translate(offset, b.rotate(degrees, box))), view);
    EXPECT_EQ(scene.camera.projection == Projection::orthographic, orthographic);
    const Affine3 map = Affine3::translate(offset) * Affine3::rotate(degrees);
    double left = 1, right = -1, low = 1, high = -1;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner =
          map.point(0.5 * size * Vec3{(i & 1) != 0 ? 1. : -1, (i & 2) != 0 ? 1. : -1, (i & 4) != 0 ? 1. : -1});
      const auto [x, y] = project(scene.camera, aspect, corner);
      left = std::min(left, x), right = std::max(right, x), low = std::min(low, y), high = std::max(high, y);
    }
    // One way it comes as near to both edges as it may, to within a pixel of a picture of 400. What the extent does not
    // know may reach a little further.
    EXPECT_GE(std::min(left, low), -0.951);
    EXPECT_LE(std::max(right, high), 0.951);
    const double wide = std::min(right, -left), tall = std::min(high, -low);
    EXPECT_GT(std::max(wide, tall), 0.945) << "round " << round;
    EXPECT_NEAR(left + right, 0, 0.005);
    EXPECT_NEAR(low + high, 0, 0.005);
  }
}

TEST(FitCamera, KeepsDirectionAndAngle) {
  SceneBuilder b;
  Camera camera;
  camera.from = {30, 0, 0};
  camera.at = {20, 0, 0};
  camera.fov = 25;
  ViewRequest view;
  view.fit = true;
  const Scene scene = compile(b.finish(b.sphere(1)), view, camera);
  EXPECT_EQ(scene.camera.fov, 25);
  EXPECT_NEAR(length(normalize(scene.camera.at - scene.camera.from) - Vec3{-1, 0, 0}), 0, 1e-12);
  // A ball seen under an angle of 25 degrees up and down, where the picture is less wide: 3/4 of the slope, less 5 %.
  const double slope = 0.95 * 0.75 * std::tan(12.5 * std::numbers::pi / 180);
  EXPECT_NEAR(scene.camera.from.x, 1 / std::sin(std::atan(slope)), 0.05);
}

TEST(ChooseCamera, AnglesTurnAroundZ) {
  const auto from = [](double azimuth, double elevation) {
    SceneBuilder b;
    ViewRequest view;
    view.angles = ViewAngles{azimuth, elevation};
    const Camera camera = compile(b.finish(b.cube({2, 2, 2}, true)), view).camera;
    return normalize(camera.from - camera.at);
  };
  EXPECT_NEAR(length(from(0, 0) - Vec3{1, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(length(from(90, 0) - Vec3{0, 1, 0}), 0, 1e-12);
  EXPECT_NEAR(length(from(-90, 0) - Vec3{0, -1, 0}), 0, 1e-12);
  EXPECT_NEAR(length(from(17, 90) - Vec3{0, 0, 1}), 0, 1e-12);
}

TEST(ChooseCamera, TheFilesCameraStandsUnlessAsked) {
  SceneBuilder b;
  Camera camera;
  camera.from = {7, 8, 9};
  EXPECT_EQ(compile(b.finish(b.sphere(1)), {}, camera).camera, camera);
  SceneBuilder other;
  ViewRequest view;
  view.camera = Camera{};
  EXPECT_EQ(compile(other.finish(other.sphere(1)), view, camera).camera, Camera{});
}

TEST(ChooseCamera, WithoutOneTheWholeSolidIsSeenFromOutside) {
  for (const Vec3 size :
       {Vec3{1, 1, 1}, Vec3{100, 1, 1}, Vec3{1, 1, 1000}, Vec3{1e-6, 1e-6, 1e-6}, Vec3{1e6, 1e6, 0.1}}) {
    const Vec3 lower{3, -5, 7};
    SceneBuilder b;
    const Camera camera = compile(b.finish(b.box(lower, lower + size)), {}).camera;
    double reach = 0;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner = lower + size * Vec3{(i & 1) != 0 ? 1. : 0, (i & 2) != 0 ? 1. : 0, (i & 4) != 0 ? 1. : 0};
      const auto [x, y] = project(camera, 4.0 / 3, corner);
      reach = std::max({reach, std::fabs(x), std::fabs(y)});
    }
    EXPECT_LT(reach, 0.9);
    EXPECT_GT(reach, 0.8);
  }
}

}  // namespace
}  // namespace tenon
