#pragma once

#include <algorithm>

#include "csg/csg_tree.h"
#include "csg/enclosures.h"

namespace tenon::cells {

/// The lengths that `cells` needs of a scene, and how they follow from one another.
///
/// *reach* R: no bounded coordinate is larger.
///
/// *resolution* τ = 2^-27 R: two crossings further apart than 2τ are told apart for certain. Whoever finds the
/// crossings without their error bounds proves that the bounds are at most τ (Certainty), or leaves the ray to the
/// exact structure. A crossing's place is off by the scene's tolerance, 2^-42 R, and the rounding of a ray from as far
/// as 2^6 R, about as much; by 1 / slope: so slopes down to 2^-13 are within τ.
///
/// *slack* 2^-20 R: boxes are met in single precision, relative to the scene's centre, at t = plane i - (origin i), i
/// being the inverse of the direction. Coordinates there are at most 2R. Across the plane the rounding of the origin,
/// moved to where the ray meets the scene, amounts to 2^-24 of 2R, that of either product to as much, that of the
/// difference to 2^-24 of 4R, and that of i to as much: 14 · 2^-24 R together, which is less.
///
/// *most_inverse* M: the inverse of a direction is no greater, so that 4 R M is a number in single precision. Of a ray
/// whose direction is longer than 2^30 / M, a plane that is a slack away is then met beyond the scene, as it should be
/// if the ray is parallel to it; shorter ones are left to the exact structure.
///
/// *growth* 4 slacks: cells are classified with their box grown by as much. It covers the slack of the stored box, that
/// of its intersection, and the 8τ on either side within which other crossings matter.
struct CellScale {
  double reach = 0;
  double resolution = 0;
  double slack = 0;
  double growth = 0;
  double most_inverse = 0;
  double least_square = 0;  ///< |direction|² of a ray that is not left to the exact structure, as it is if it is ...
  static constexpr double most_square = 0x1p200;  ///< ... greater than this
  double far_origin = 0;  ///< rays that start further off (per coordinate) are left to the exact structure

  static CellScale of(const CsgTree& tree) {
    CellScale s;
    for (const Leaf& leaf : tree.leaves) {
      if (leaf.bounds.is_bounded()) s.reach = std::max(s.reach, leaf.bounds.largest_coordinate());
    }
    s.resolution = 0x1p-27 * s.reach;
    s.slack = 0x1p-20 * s.reach;
    s.growth = 4 * s.slack;
    s.most_inverse = std::min(0x1p100, 0x1p120 / s.reach);
    s.least_square = (0x1p30 / s.most_inverse) * (0x1p30 / s.most_inverse);
    s.far_origin = 0x1p6 * s.reach;
    return s;
  }
};

}  // namespace tenon::cells
