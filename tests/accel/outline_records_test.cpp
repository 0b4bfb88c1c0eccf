#include <gtest/gtest.h>

#include "accel/cells/leaf_pieces.h"
#include "accel/cells/planes_recorder.h"
#include "accel/cells_checks.h"
#include "primitive/dispatch.h"

namespace tenon {
namespace {

using namespace cells;
using namespace cells_checks;

// Where a ray that starts on a wall is said to be certain of where it meets that wall again, the bounds of spans() are
// as small as is promised; and nearly all are said to be.
TEST(OutlineRecords, StartsOnWallsAreAsCertainAsTheySay) {
  Outline rounded{{{}}};
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 == 0 ? 0.8 : 1, angle = 36.0 * i;
    rounded.loops[0].push_back({r * cos_degrees(angle), r * sin_degrees(angle), i % 3 == 0 ? 0.4 : 0});
  }
  for (const double taper : {1.0, 0.5, 1.6}) {
    SCOPED_TRACE(taper);
    SceneBuilder b;
    const SceneNodeId solid = b.rotate({20, 0, 30}, b.primitive("prism", {rounded, 1.0, true, taper}));
    const CsgTree tree = b.tree(b.unite({solid, b.translate({2, 0, 0}, b.sphere(0.1))}));
    const CellScale scale = CellScale::of(tree);
    const LeafId id{0};
    const Leaf& leaf = tree[id];
    LeafPieces pieces(tree, scale, {0, 0, 0});
    const auto none = build_accelerator("none", tree);
    const auto context = (*none)->make_context();
    Draw draw(44);
    int starts = 0, certain = 0, again = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vec3 from = 5 * draw.direction(), aim = draw.direction();
      const Hit start = (*none)->first_hit({{from, aim - from}}, *context);
      if (!start.found() || start.surface.leaf != id) continue;
      const Vec3 half = draw.real(0.01, 0.3) * Vec3{1, 1, 1};
      if (!pieces.find(id, {start.point - half, start.point + half})) continue;
      if (pieces.kind() != RecordKind::outline_piece) continue;
      LeafRecords records;
      const RecordRef ref(RecordKind::outline, append_values(pieces.values(), records.lines));
      const Vec3 direction = draw.direction();
      const auto face = static_cast<int>(start.surface.face);
      ++starts;
      if (!records.start_is_certain(ref, face, direction)) continue;
      ++certain;
      Spans found;
      spans(tree.primitives, leaf.primitive, leaf.placement, {start.point, direction}, tree.tolerance.distance, face,
            found);
      for (const Crossing& c : found) {
        if (c.face / 2 != start.surface.face / 2 || c.t == 0) continue;
        EXPECT_LE(c.bound, scale.certain) << "start " << i << ", met again at " << c.t;
        ++again;
      }
    }
    EXPECT_GT(starts, 2000);
    EXPECT_GT(certain, 0.98 * starts);
    EXPECT_GT(again, 50);
  }
}

}  // namespace
}  // namespace tenon
