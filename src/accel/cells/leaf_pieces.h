#pragma once

#include <vector>

#include "accel/cells/cell_scale.h"
#include "csg/csg_tree.h"

namespace tenon::cells {

/// What leaves of costly kinds come to within small boxes: where few faces of one go through, it is what lies below a
/// few planes, as a convex solid does, or all but that (planes_within() of the primitive).
class LeafPieces {
 public:
  /// @param center  what the records' places are relative to
  LeafPieces(const CsgTree& tree, const CellScale& scale, const Vec3& center)
      : tree_(tree), scale_(scale), center_(center) {}

  /// Whether a leaf is of a kind that has pieces at all.
  static bool may_have(const CsgTree& tree, const Leaf& leaf);

  /// Finds the piece of a leaf that stands for it within a box of the world.
  /// @return whether there is one
  bool find(LeafId leaf, const Box3& box);
  /// A box around the surface of the piece that was found last, within the box.
  Box3 surface() const;
  /// The numbers of its ConvexRecord.
  const std::vector<double>& values() const { return values_; }

 private:
  const CsgTree& tree_;
  const CellScale& scale_;
  const Vec3 center_;
  Box3 box_;
  std::vector<Plane> planes_;  // in the leaf's frame
  std::vector<double> values_;
};

}  // namespace tenon::cells
