#pragma once

#include <cstdint>
#include <vector>

#include "math/bounded_root.h"
#include "primitive/bezier_patch.h"
#include "primitive/local_ray.h"

namespace tenon {

/// Where a line meets a patch.
struct PatchRoot : BoundedRoot {
  double u = 0, v = 0;
  bool against = false;  ///< the normal, by_u × by_v, points against the line
};

/// How roots are found (course, "Intersecting bicubic surfaces").
enum class PatchMethod : std::uint8_t {
  interval,     ///< the interval method on f(u, v) = g(u, v) = 0
  resultant,    ///< v is eliminated (Kajiya 1982), and the interval method keeps to where the resultant may be 0
  subdivision,  ///< recursively, into parts that are small enough
};

/// Appends the places where a line meets a patch, by its distances f and g from two planes through the line. (The
/// course's planes degenerate where the line runs through the origin; here both are perpendicular to each other.)
///
/// A part of the patch where f or g stays away from zero, errors included, is left out. Where the preconditioned pair
/// is so near the identity that it takes no value twice, Newton's method finds the one root there may be; else the part
/// is halved. What is still undecided when u and v have no more bits to tell it by counts as a root: a place where the
/// line touches the patch, or one where all of an edge is one point.
///
/// Roots up to their own error beyond an edge are reported, so that patches that share the edge leave no gap.
///
/// @param size  of the parts that PatchMethod::subdivision ends with
void find_patch_roots(const BezierNet<Vec3>& patch, const LocalRay& ray, PatchMethod method, double size,
                      std::vector<PatchRoot>& roots);

/// by_u × by_v; where an edge is one point, that of a place next to it.
Vec3 patch_normal(const BezierNet<Vec3>& patch, double u, double v);

}  // namespace tenon
