#include "render/straight_light.h"

#include <gtest/gtest.h>

#include "support/scene_builder.h"
#include "tenon/accel/section_light.h"

namespace tenon {
namespace {

using fixtures::SceneBuilder;

// A block, a ball beside it and a wall behind the ball. A section takes away what lies from 10 to 20 and from 30 on: a
// part of the block, and the wall.
CsgTree block_ball_and_wall(bool cut) {
  SceneBuilder b;
  const SceneNodeId whole = b.unite({b.cube({30, 30, 30}, true), b.translate({25, 0, 0}, b.sphere(3)),
                                     b.translate({40, 0, 0}, b.cube({4, 30, 30}, true))});
  if (!cut) return b.tree(whole);
  const SceneNodeId slab =
      b.intersect({b.primitive("halfspace", {Vec3{-1, 0, 0}, -10.0}), b.primitive("halfspace", {Vec3{1, 0, 0}, 20.0})});
  return b.tree(b.subtract({whole, slab, b.primitive("halfspace", {Vec3{-1, 0, 0}, -30.0})}));
}

// What a ray starts at decides whether it meets what a section has taken away, boundaries on its way do not.
TEST(StraightLight, FromACutFaceNeverMeetsWhatWasTakenAway) {
  const CsgTree cut = block_ball_and_wall(true), whole = block_ball_and_wall(false);
  const auto accelerator = light_of_the_whole(std::move(build_accelerator("cells", cut)).value(),
                                              std::move(build_accelerator("cells", whole)).value(), LeafId{3});
  const auto context = accelerator->make_context();
  RayQuery seen;
  seen.ray = {{18, 0, 0}, {-1, 0, 0}};
  const Hit face = accelerator->first_hit(seen, *context);
  ASSERT_EQ(face.point.x, 10);
  std::vector<RayQuery> queries(1);
  queries[0].ray = {face.point, {1, 0, 0}};
  queries[0].t_max = 100;
  queries[0].kind = RayKind::shadow;
  queries[0].from = &face;

  const Scene scene;
  const LitScene lit(scene);
  StraightLight light(lit, *accelerator);
  const auto start = [](std::size_t) { return medium_outside; };
  const auto let_through = [](const Hit& boundary, const RayQuery&) {
    return boundary.surface.leaf == LeafId{1} ? Rgb{0.5, 0.5, 0.5} : Rgb{};
  };
  EXPECT_EQ(light.shares(queries, start, let_through, *context)[0], (Rgb{0.25, 0.25, 0.25}));
}

}  // namespace
}  // namespace tenon
