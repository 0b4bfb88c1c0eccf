#include "support/scene_builder.h"

namespace tenon {
namespace {

using fixtures::SceneBuilder;
using fixtures::Tracer;

// A ray that sinks into the top of a slab so slowly that where it does is not known to within the slab's length. What
// stands behind the slab is met where it is, and the gap before it stays open.
TEST(SkimmedFace, DoesNotReachBehindItsSolid) {
  SceneBuilder b;
  const CsgTree tree = b.tree(b.unite({b.box({0, -5, -1}, {10, 5, 0}), b.translate({13, 0, 0}, b.sphere(1))}));
  Tracer tracer(tree);
  for (const double slope : {1e-13, 1e-12, 1e-11}) {
    const auto spans = tracer.all_spans({{-5, 0.3, 10 * slope}, {1, 0, -slope}});
    ASSERT_FALSE(spans.empty());
    const double enter = 18 - std::sqrt(1 - 0.09), leave = 18 + std::sqrt(1 - 0.09);
    EXPECT_NEAR(spans.back().t_in, enter, 1e-9) << slope;  // z is within 1e-10 of the sphere's middle
    EXPECT_NEAR(spans.back().t_out, leave, 1e-9) << slope;
    if (spans.size() == 2) {
      EXPECT_GE(spans[0].t_in, 5 - 1e-9);
      EXPECT_NEAR(spans[0].t_out, 15, 1e-9);
    }
  }
}

}  // namespace
}  // namespace tenon
