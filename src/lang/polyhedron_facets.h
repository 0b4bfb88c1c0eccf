#pragma once

#include <optional>
#include <vector>

#include "lang/convex_parts.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon::lang {

/// The triangles of a polyhedron where it stands, counterclockwise as seen from outside.
struct PolyhedronFacets {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Corners> triangles;
};

/// Those of a cube, a convex polyhedron, or a mesh that is a solid; nothing for other primitives.
std::optional<PolyhedronFacets> polyhedron_facets(const UnionLeaf& leaf);

}  // namespace tenon::lang
