#pragma once

#include "mesh/build_mesh.h"
#include "mesh/height_map.h"

namespace tenon {

/// Whether a file is a mesh that load_mesh() reads, by the ending of its name.
bool is_mesh_file(const std::string& path);

/// Reads a mesh file: STL, OBJ, OFF, PLY, 3MF or AMF, by the ending of its name.
///
/// @param hull  see build_mesh()
/// @return an error of kind input with its place in the file, or of kind machine when the file cannot be read
Result<BuiltMesh> load_mesh(const std::string& path, bool hull);

/// The same of a file that has been read.
Result<BuiltMesh> parse_mesh(const MeshFile& file, bool hull);

/// Reads a height map as a solid; see read_height_map().
Result<BuiltMesh> load_height_map(const std::string& path, const HeightMapOptions& options);

}  // namespace tenon
