#pragma once

#include <span>
#include <vector>

#include "tenon/math/vec3.h"

namespace tenon {

/// A convex polyhedron by its corners.
struct ConvexHull {
  std::vector<Vec3> points;                     ///< those of the hull alone
  std::vector<std::vector<std::size_t>> faces;  ///< into `points`, around each face; what is flat is one face
};

/// The convex hull of points, by Qhull: the others lie within its faces but for rounding.
/// @return no faces where all points lie in a plane
ConvexHull convex_hull(std::span<const Vec3> points);

}  // namespace tenon
