#pragma once

#include "mesh/build_mesh.h"

namespace tenon {

/// Reads a mesh file: STL, OBJ, OFF or PLY, by the ending of its name.
///
/// @param hull  see build_mesh()
/// @return an error of kind input with its place in the file, or of kind machine when the file cannot be read
Result<BuiltMesh> load_mesh(const std::string& path, bool hull);

/// The same of a file that has been read.
Result<BuiltMesh> parse_mesh(const MeshFile& file, bool hull);

}  // namespace tenon
