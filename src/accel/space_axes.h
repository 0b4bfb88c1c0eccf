#pragma once

#include <vector>

#include "csg/csg_tree.h"
#include "tenon/accel/screen_view.h"
#include "tenon/math/affine3.h"
#include "tenon/math/box3.h"
#include "tenon/math/ray.h"

namespace tenon {

/// The axes along which space is subdivided: the world's, or the eye's (RR-612 §3.1), turned about the world's origin.
///
/// The origin stays where it is, so that coordinates do not grow with the distance of the eye and enclosure_margin()
/// holds for them: a turn makes none larger than sqrt 3 times the largest, and adds 2^-51 of it in rounding.
class SpaceAxes {
 public:
  static SpaceAxes world() { return {}; }
  static SpaceAxes eye(const ScreenView& view);

  Vec3 from_world(const Vec3& v) const { return turned_ ? axes_from_world_.direction(v) : v; }
  Ray from_world(const Ray& ray) const { return {from_world(ray.origin), from_world(ray.direction)}; }
  ScreenView from_world(ScreenView view) const;

  /// The box of a whole primitive along these axes; Box3::everything() for an unbounded one.
  Box3 bounds_of(const CsgTree& tree, LeafId leaf) const;

  /// By LeafId: the minimum enclosure of each leaf (RR-612 §3.1) along these axes, grown by enclosure_margin(). Empty
  /// for a leaf that cannot matter, Box3::everything() for an unbounded one.
  std::vector<Box3> minimum_enclosures_of(const CsgTree& tree) const;

 private:
  Affine3 axes_from_world_;
  bool turned_ = false;
};

}  // namespace tenon
