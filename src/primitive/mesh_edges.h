#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// An edge of a triangle.
struct EdgeUse {
  std::uint32_t low, high;  ///< vertices, in rising order
  std::uint32_t triangle;
  bool rising;  ///< the triangle runs along it from low to high

  std::pair<std::uint32_t, std::uint32_t> ends() const { return {low, high}; }
};

/// The edges of all triangles, by their ends.
std::vector<EdgeUse> sorted_edge_uses(std::span<const TriangleMesh::Corners> triangles);

/// Edges that keep a mesh from being closed: those that triangles run along more often in one direction than in the
/// other.
struct OpenEdges {
  std::size_t count = 0;       ///< how many there are
  std::uint32_t from = 0;      ///< the first: between these vertices,
  std::uint32_t to = 0;        ///< run along more often in this direction
  std::uint32_t triangle = 0;  ///< by this triangle
  std::size_t forth = 0;       ///< how often
  std::size_t back = 0;        ///< and how often in the other
};

/// A mesh encloses a solid when as many triangles run along each edge in one direction as in the other: it is closed,
/// and its triangles face one way. Edges of more than two triangles, where solids touch, are allowed.
/// @return nothing for such a mesh
std::optional<OpenEdges> find_open_edges(std::span<const TriangleMesh::Corners> triangles);

}  // namespace tenon
