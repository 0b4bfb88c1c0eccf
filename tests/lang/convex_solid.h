#pragma once

#include <sstream>
#include <vector>

#include "csg/csg_tree.h"
#include "lang/language.h"
#include "primitive/dispatch.h"
#include "support/random.h"
#include "support/scene_builder.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// A ball, or with radius 0 a point, that a convex hull is spanned by.
struct SpanningBall {
  Vec3 center;
  double radius = 0;
};

/// Text of the scene language that makes them, the points as the corners of tetrahedra of their own.
inline std::string scad_of(const std::vector<SpanningBall>& balls) {
  std::ostringstream out;
  out.precision(17);
  for (const SpanningBall& ball : balls) {
    out << "translate([" << ball.center.x << ", " << ball.center.y << ", " << ball.center.z << "]) sphere("
        << ball.radius << ");\n";
  }
  return out.str();
}

/// A scene whose solid is a union.
class UnionScene {
 public:
  explicit UnionScene(const std::string& text) : outcome_(evaluate(text)) {
    EXPECT_TRUE(outcome_.model.ok()) << (outcome_.model ? "" : format_error(outcome_.model.error()));
    Result<Scene> scene = compile_scene(std::move(*outcome_.model), outcome_.diagnostics);
    EXPECT_TRUE(scene.ok());
    scene_ = std::move(*scene);
  }

  /// Max n·p over its points.
  double support(const Vec3& n) const {
    double greatest = -HUGE_VAL;
    for (const Leaf& leaf : scene_.tree->leaves) {
      greatest = std::max(greatest, world_support(scene_.tree->primitives, leaf.primitive, leaf.placement, n));
    }
    return greatest;
  }
  std::vector<SolidSpan> spans(const Ray& ray) const { return fixtures::Tracer(*scene_.tree).all_spans(ray); }

 private:
  Outcome outcome_;
  Scene scene_;
};

/// Whether a solid is the convex hull of balls: it reaches as far in every direction, and no line leaves it and comes
/// back.
inline void expect_hull(const std::string& text, const std::vector<SpanningBall>& balls, Random& random,
                        double tolerance) {
  const UnionScene scene(text);
  Vec3 middle;
  double size = 0;
  for (const SpanningBall& ball : balls) middle += ball.center / static_cast<double>(balls.size());
  for (const SpanningBall& ball : balls) size = std::max(size, length(ball.center - middle) + ball.radius);
  for (int i = 0; i < 200; ++i) {
    const Vec3 n = random.direction();
    double expected = -HUGE_VAL;
    for (const SpanningBall& ball : balls) expected = std::max(expected, dot(n, ball.center) + ball.radius);
    EXPECT_NEAR(scene.support(n), expected, tolerance * size) << text;
  }
  int met = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 target = middle + size * random.uniform(0, 1) * random.direction(), way = random.direction();
    const auto spans = scene.spans({target - 4 * size * way, way});
    EXPECT_LE(spans.size(), 1u) << text;
    met += spans.empty() ? 0 : 1;
  }
  EXPECT_GT(met, 20);
}

}  // namespace tenon
