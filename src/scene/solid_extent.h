#pragma once

#include <vector>

#include "accel/cells/leaf_regions.h"
#include "accel/cells/local_expression.h"
#include "csg/csg_tree.h"

namespace tenon {

/// How far a solid reaches in any direction: not the primitives it is made of, but what the operations leave of them.
///
/// Space is halved where the solid may reach farthest (best first), and the expression folded in each part, until a
/// part is so small that the answer is known to `resolution`.
class SolidExtent {
 public:
  /// @param tree  outlives this
  explicit SolidExtent(const CsgTree& tree);

  /// A box around the solid; of what has no end, around its primitives that have one.
  const Box3& enclosure() const { return enclosure_; }
  /// The error that support() may have, upward, for n of length 1.
  double resolution() const { return resolution_; }

  /// The largest n·p over the solid, or a little more; never less. -inf where the solid is empty. Known to
  /// resolution(), except of a face that lies askew in space and square to n, to some 2^-7 of the whole.
  /// @param n  any length but zero
  double support(const Vec3& n);

  /// Whether nothing is left of the solid, as far as the resolution tells.
  bool is_empty() { return support({0, 0, 1}) == -Box3::inf; }

 private:
  struct Part {
    Box3 box;
    cells::LocalExpression expression;
    double bound = 0;  // no point of the solid in the box lies farther along n
    int depth = 0;
    bool inside = false;
  };
  // The part that may reach farthest is the heap's front; of equal ones the smaller, so that a flat face is not tiled.
  static bool reaches_less(const Part& a, const Part& b) {
    return a.bound != b.bound ? a.bound < b.bound : a.depth < b.depth;
  }

  double expression_support(const cells::LocalExpression& expression) const;
  void add_part(const Box3& box, const Part& whole, const Vec3& n);
  bool is_small(const Box3& box) const { return max_component(box.size()) <= resolution_; }

  const CsgTree& tree_;
  Box3 enclosure_;
  double resolution_ = 0;
  cells::LeafRegions leaf_regions_;
  cells::OwnerRanks ranks_;  // who owns a point makes no difference
  cells::LocalExpression whole_;
  cells::Folder folder_{ranks_};
  std::vector<double> leaf_supports_;  // by LeafId, of the direction being asked for
  std::vector<Part> parts_;            // a heap
};

}  // namespace tenon
