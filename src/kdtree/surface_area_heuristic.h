#pragma once

#include "kdtree/kd_tree.h"

namespace tenon {

/// What it costs a ray that meets a cell, on average, when the cell is split: eq. 1.2 of Zajíček 2012 with the sum of
/// its primitives' costs for N * C_p, and eq. 2.1, Hunt's correction for primitives that are tested once although they
/// stand on both sides.
///
/// SA(Split) in eq. 2.1 can be read as the area of the splitting plane or as that of its two sides. The rays that pass
/// both sides are 2 A / SA(B) of all for a plane of area A; but with that, and a C_t below 0.6 tests, the grooved
/// sphere is split, which the thesis says it is not (§4.3, with either heuristic). So the area is taken once, as its
/// words have it: "the surface area common to the children of the node. This is effectively the splitting plane."
class SurfaceAreaHeuristic {
 public:
  SurfaceAreaHeuristic(KdSplit split, double traversal_cost, const Box3& cell)
      : modified_(split == KdSplit::msah),
        traversal_cost_(traversal_cost),
        size_(cell.size()),
        area_(half_area(size_)) {}

  /// @param at     distance of the plane from the cell's lower face
  /// @param below, above, both   costs of the items below, above, and of those on both sides
  double cost(int axis, double at, double below, double above, double both) const {
    Vec3 size_below = size_, size_above = size_;
    size_below[axis] = at;
    size_above[axis] = size_[axis] - at;
    double sum = half_area(size_below) * below + half_area(size_above) * above;
    if (modified_) sum -= 0.5 * size_[(axis + 1) % 3] * size_[(axis + 2) % 3] * both;
    return traversal_cost_ + sum / area_;
  }

 private:
  static double half_area(const Vec3& s) { return s.x * s.y + s.y * s.z + s.z * s.x; }

  bool modified_;
  double traversal_cost_;
  Vec3 size_;
  double area_;
};

}  // namespace tenon
