#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// Triangles of one mesh that pass through one another.
struct SelfIntersection {
  static constexpr std::size_t most_counted = 1000;

  std::size_t count = 0;                ///< pairs of triangles; counting ends at most_counted
  std::uint32_t first = 0, second = 0;  ///< the pair with the lowest numbers
  Vec3 place;                           ///< where an edge of one passes through the other
};

/// Finds the pairs of triangles of which an edge of one certainly passes through the inside of the other: by more than
/// rounding. Triangles that touch, or that lie in one plane, do not.
/// @return nothing for a mesh without such pairs
std::optional<SelfIntersection> find_self_intersection(const TriangleMesh& mesh);

}  // namespace tenon
