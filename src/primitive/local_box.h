#pragma once

#include <array>

#include "tenon/math/box3.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// Where a box lies with respect to a solid. `outside` and `inside` are certain; `straddles` is always a right answer.
enum class Region { outside, inside, straddles };

/// How some planes, each the bound of what lies below it (n·p <= d), make up the part of a solid within a box.
enum class PlanarPart {
  unknown,    ///< they do not, or that is not certain
  below_all,  ///< the solid is what lies below all of them
  above_any,  ///< it is what lies above one of them, at least: all but a notch
};

/// A box of the world seen from a primitive's local frame, where it is a parallelepiped.
struct LocalBox {
  Vec3 center;
  std::array<Vec3, 3> half_edges;  ///< the corners are center ± half_edges[0] ± half_edges[1] ± half_edges[2]
  Vec3 error;                      ///< bound on the error of each corner, per axis
  Box3 bounds;                     ///< around the corners, grown by their error

  constexpr Vec3 corner(int i) const {
    return center + half_edges[0] * ((i & 1) != 0 ? 1.0 : -1.0) + half_edges[1] * ((i & 2) != 0 ? 1.0 : -1.0) +
           half_edges[2] * ((i & 4) != 0 ? 1.0 : -1.0);
  }
};

}  // namespace tenon
