#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tenon/math/vec3.h"

namespace tenon {

/// What finds the triangles that a ray meets, within the primitive (Zajíček 2012, §3.2). The answers are the same.
enum class MeshStructure {
  bvh,  ///< a bounding volume hierarchy, eight children a node
  kd,   ///< the thesis's kd-tree
};

/// Triangles over shared vertices.
struct TriangleMesh {
  using Corners = std::array<std::uint32_t, 3>;

  std::vector<Vec3> vertices;           ///< no two of them equal, where the mesh is a solid
  std::vector<Corners> triangles;       ///< into `vertices`; counterclockwise as seen from outside
  std::vector<Vec3> normals;            ///< for shading, any length but zero; empty where faces are flat
  std::vector<Corners> corner_normals;  ///< into `normals`, one entry a triangle; empty where `normals` is
  MeshStructure local = MeshStructure::bvh;
  bool winds_once = false;  ///< known, of a solid: it winds around each place once or not at all
  std::string source;       ///< the statement of the scene language that makes it again; may be empty

  /// The corners of a triangle.
  std::array<Vec3, 3> corners(std::size_t triangle) const {
    const Corners& c = triangles[triangle];
    return {vertices[c[0]], vertices[c[1]], vertices[c[2]]};
  }
};

}  // namespace tenon
