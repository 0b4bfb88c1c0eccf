#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// Triangles of one closed mesh that pass through one another.
struct SelfIntersection {
  static constexpr std::size_t most_counted = 1000;

  std::size_t count = 0;                ///< pairs of triangles; counting ends at most_counted
  std::uint32_t first = 0, second = 0;  ///< the pair with the lowest numbers
  Vec3 place;                           ///< about where
};

/// Finds the pairs of triangles where the solid that a closed mesh bounds overlaps itself. All is decided exactly, for
/// the coordinates as they are. A pair counts
/// * where the inside of one passes through that of the other,
/// * where both lie in one plane, face one way, and overlap,
/// * where an edge of one runs through the other, or along an edge of it, and the surfaces that meet there pass through
///   one another, or bound solids that overlap beside the edge (EdgeFan).
///
/// Solids that touch in a face, an edge or a point do not overlap, whether they share vertices there or not; nor do
/// parts that lie within one another and touch nowhere (find_idle_parts tells of those).
/// @return nothing for a mesh without such pairs
std::optional<SelfIntersection> find_self_intersection(const TriangleMesh& mesh);

}  // namespace tenon
