#include "tenon/accel/section_light.h"

#include "support/scene_builder.h"

namespace tenon {
namespace {

using fixtures::SceneBuilder;

// A hollow box whose lid a section takes away; a lamp above it.
class SectionLightTest : public testing::Test {
 protected:
  SectionLightTest() : cut_(tree(true)), whole_(tree(false)) {
    accelerator_ = light_of_the_whole(std::move(build_accelerator("cells", cut_)).value(),
                                      std::move(build_accelerator("cells", whole_)).value(), LeafId{2});
    context_ = accelerator_->make_context();
  }

  static CsgTree tree(bool cut) {
    SceneBuilder b;
    const SceneNodeId box = b.subtract({b.cube({10, 10, 10}, true), b.cube({8, 8, 8}, true)});
    if (!cut) return b.tree(box);
    return b.tree(b.subtract({box, b.primitive("halfspace", {Vec3{0, 0, -1}, -2.0})}));
  }

  Hit seen_from_above(double x) {
    RayQuery query;
    query.ray = {{x, 0, 50}, {0, 0, -1}};
    return accelerator_->first_hit(query, *context_);
  }
  RayQuery upward(const Hit& hit, RayKind kind) const {
    RayQuery query;
    query.ray = {hit.point, {0, 0, 1}};
    query.kind = kind;
    query.from = &hit;
    return query;
  }

  CsgTree cut_, whole_;
  std::unique_ptr<Accelerator> accelerator_;
  std::unique_ptr<TraceContext> context_;
};

TEST_F(SectionLightTest, WhatIsSeenIsCut) {
  EXPECT_EQ(seen_from_above(0).point.z, -4) << "the bottom, through the lid";
  EXPECT_EQ(seen_from_above(4.5).point.z, 2) << "the cut face";
}

TEST_F(SectionLightTest, WhatWasTakenAwayCastsItsShadow) {
  const Hit bottom = seen_from_above(0);
  EXPECT_TRUE(accelerator_->occluded(upward(bottom, RayKind::shadow), *context_));
  EXPECT_EQ(accelerator_->first_hit(upward(bottom, RayKind::diffuse), *context_).point.z, 4);
  EXPECT_FALSE(accelerator_->first_hit(upward(bottom, RayKind::reflected), *context_).found())
      << "mirrors show the cut";
}

TEST_F(SectionLightTest, CutFacesAreLit) {
  const Hit face = seen_from_above(4.5);
  EXPECT_FALSE(accelerator_->occluded(upward(face, RayKind::shadow), *context_));
  EXPECT_FALSE(accelerator_->first_hit(upward(face, RayKind::diffuse), *context_).found());
}

TEST_F(SectionLightTest, ManyRaysAtOnceAreEachAnsweredByTheirSide) {
  const Hit bottom = seen_from_above(0), face = seen_from_above(4.5);
  std::vector<RayQuery> queries;
  for (int i = 0; i < 9; ++i) queries.push_back(upward(i % 3 == 0 ? face : bottom, RayKind::shadow));
  std::vector<RayBoundary> boundaries(queries.size());
  accelerator_->first_boundaries(queries, boundaries, *context_);
  for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_EQ(boundaries[i].found(), i % 3 != 0) << i;
  EXPECT_EQ(context_->statistics[RayKind::shadow].rays, 9u);
  EXPECT_EQ(context_->statistics[RayKind::primary].rays, 2u);
}

}  // namespace
}  // namespace tenon
