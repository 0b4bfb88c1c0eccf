#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "primitive/local_ray.h"
#include "tenon/math/box3.h"

namespace tenon {

/// A ray's line, ready to be held against boxes and triangles, or one a lane: seen along the axis of its largest
/// component, as the origin of a plane onto which everything is sheared (Woop, Benthin, Wald, "Watertight Ray/Triangle
/// Intersection", 2013). What the line is wrong by is bounded once for the whole mesh.
/// @tparam Number, Vector  double and Vec3, or as many side by side
template <class Number, class Vector>
struct MeshLineOf {
  Vector origin;
  Vector direction;  ///< scaled by a power of two to about 1, so that products stay in range
  Number scale;      ///< t of the ray = scale * t of this line
  Vector origin_error;
  Vector direction_error;  ///< of `direction`
  int along = 2;           ///< the axis of the largest component of the direction
  int across[2] = {0, 1};
  Number shear[2];
  /// Bounds on how far apart the exact line and a vertex, both sheared, may be from where they are computed to be.
  Number shear_error[2];
  Vector growth;       ///< how far, per axis, the exact line may be from this one within the bounds of the mesh
  Number farthest;     ///< |t| of any point of the mesh
  Number along_error;  ///< of t, where a coordinate along the axis is given
};

struct MeshLine : MeshLineOf<double, Vec3> {
  /// @param bounds  of the mesh; finite
  MeshLine(const LocalRay& ray, const Box3& bounds);
};

/// A line against boxes, with all that it may be wrong by: the near and far planes are met at
/// (plane - begin) * inverse. A direction without a component along an axis gets one that takes it nowhere within the
/// mesh: 2^-200 of the largest. Rounding is monotonic, so a box is met whenever one within it is.
struct MeshSlabs {
  std::array<double, 3> near_begin, far_begin, inverse;
  std::array<bool, 3> forward;

  explicit MeshSlabs(const MeshLine& line) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      const double d = line.direction[axis], least = 0x1p-200 * std::fabs(line.direction[line.along]);
      forward[i] = !(d < 0);
      inverse[i] = 1 / (std::fabs(d) < least ? (forward[i] ? least : -least) : d);
      const double grow = forward[i] ? line.growth[axis] : -line.growth[axis];
      near_begin[i] = line.origin[axis] + grow;
      far_begin[i] = line.origin[axis] - grow;
    }
  }

  bool meets(const Box3& box) const {
    double enter, leave;
    clip(box, enter, leave);
    // An infinite growth gives no order; then everything is met.
    return !(enter > leave);
  }
  /// The part of the line within the box.
  void clip(const Box3& box, double& enter, double& leave) const {
    enter = -Box3::inf;
    leave = Box3::inf;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double lower = box.lower[static_cast<int>(axis)], upper = box.upper[static_cast<int>(axis)];
      enter = std::max(enter, ((forward[axis] ? lower : upper) - near_begin[axis]) * inverse[axis]);
      leave = std::min(leave, ((forward[axis] ? upper : lower) - far_begin[axis]) * inverse[axis]);
    }
  }
};

}  // namespace tenon
