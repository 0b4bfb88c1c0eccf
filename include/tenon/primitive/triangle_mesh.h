#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tenon/math/vec3.h"

namespace tenon {

/// Triangles over shared vertices.
struct TriangleMesh {
  using Corners = std::array<std::uint32_t, 3>;

  std::vector<Vec3> vertices;           ///< no two of them equal, where the mesh is a solid
  std::vector<Corners> triangles;       ///< into `vertices`; counterclockwise as seen from outside
  std::vector<Vec3> normals;            ///< for shading, any length but zero; empty where faces are flat
  std::vector<Corners> corner_normals;  ///< into `normals`, one entry a triangle; empty where `normals` is
  std::string source;                   ///< the statement of the scene language that makes it again; may be empty

  /// The corners of a triangle.
  std::array<Vec3, 3> corners(std::size_t triangle) const {
    const Corners& c = triangles[triangle];
    return {vertices[c[0]], vertices[c[1]], vertices[c[2]]};
  }
};

}  // namespace tenon
