#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "primitive/local_ray.h"
#include "tenon/math/box3.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// A ray's line, ready to be held against boxes and triangles: seen along the axis of its largest component, as the
/// origin of a plane onto which everything is sheared (Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection",
/// 2013). What the line is wrong by is bounded once for the whole mesh.
struct MeshLine {
  Vec3 origin;
  Vec3 direction;    ///< scaled by a power of two to about 1, so that products stay in range
  double scale = 1;  ///< t of the ray = scale * t of this line
  Vec3 origin_error;
  Vec3 direction_error;  ///< of `direction`
  int along = 2;         ///< the axis of the largest component of the direction
  int across[2] = {0, 1};
  double shear[2] = {0, 0};
  /// Bounds on how far apart the exact line and a vertex, both sheared, may be from where they are computed to be.
  double shear_error[2] = {0, 0};
  Vec3 growth;             ///< how far, per axis, the exact line may be from this one within the bounds of the mesh
  double farthest = 0;     ///< |t| of any point of the mesh
  double along_error = 0;  ///< of t, where a coordinate along the axis is given

  /// @param bounds  of the mesh; finite
  MeshLine(const LocalRay& ray, const Box3& bounds) : origin(ray.origin), origin_error(ray.origin_error) {
    const Vec3 size = abs(ray.direction);
    along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    across[0] = (along + 1) % 3;
    across[1] = (along + 2) % 3;
    scale = power_of_two_over(size[along]);
    direction = scale * ray.direction;
    direction_error = scale * ray.direction_error;

    const double steep = std::fabs(direction[along]);
    const Vec3 reach = max(abs(bounds.lower - origin), abs(bounds.upper - origin));
    // Where the exact line has the coordinate of a point of the mesh, its own t lies this far from 0 at most. A
    // direction of which nothing is known makes everything below infinite, and no triangle certain.
    const double least = steep - direction_error[along];
    farthest = least > 0 ? (reach[along] + origin_error[along]) / least * (1 + gamma(4)) : Box3::inf;
    const Vec3 off = origin_error + farthest * direction_error;
    along_error = off[along] / steep * (1 + gamma(4)) + gamma(4) * farthest;
    for (int i = 0; i < 2; ++i) {
      shear[i] = direction[across[i]] / direction[along];
      // The difference, the quotient, the product and the sum round once each.
      shear_error[i] = (off[across[i]] + std::fabs(shear[i]) * off[along]) * (1 + gamma(6)) +
                       gamma(6) * (reach[across[i]] + std::fabs(shear[i]) * reach[along]);
    }
    // What a slab's quotient rounds by, as a distance.
    growth = off + gamma(8) * (reach + abs(origin));
  }

  // About 1 / x, from 2^-1000 to 2^1000.
  static double power_of_two_over(double x) {
    const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023;
    return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + std::clamp(-exponent, -1000, 1000)) << 52);
  }

  double t_of(const Vec3& p) const { return (p[along] - origin[along]) / direction[along]; }
  /// A point's place in the plane, relative to the line.
  void project(const Vec3& p, double& x, double& y) const {
    const double height = p[along] - origin[along];
    x = (p[across[0]] - origin[across[0]]) - shear[0] * height;
    y = (p[across[1]] - origin[across[1]]) - shear[1] * height;
  }
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
