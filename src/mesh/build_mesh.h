#pragma once

#include <string>
#include <vector>

#include "mesh/polygon_soup.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// Triangles that a primitive can be made of, and what had to be done for that.
struct BuiltMesh {
  TriangleMesh mesh;
  std::vector<std::string> notes;  ///< for a warning each
};

/// Makes a mesh of what a file or a scene says: equal points become one vertex, faces become triangles, and for a solid
/// the triangles must close it and face outward.
///
/// Mended is what is certain: faces without area are left out, a face that stands there twice is taken once where the
/// mesh is closed without it, and a mesh that faces inward throughout is turned. A mesh that overlaps itself is told
/// with a note, as are parts of it that add nothing: its solid is the union of its parts.
///
/// @param what  what it is, for messages: "the mesh", "the polyhedron"
/// @param hull  the surface alone is wanted: nothing needs to be closed
/// @return the mesh without triangles when nothing has any area; an error (without place) that says what keeps it from
///         being a solid, how often, and where first
Result<BuiltMesh> build_mesh(const PolygonSoup& soup, const std::string& what, bool hull);

}  // namespace tenon
