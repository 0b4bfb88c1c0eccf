#include "mesh/load_mesh.h"

#include <algorithm>

namespace tenon {

namespace {

using Reader = Result<PolygonSoup> (*)(const MeshFile&);

constexpr std::pair<const char*, Reader> readers[] = {{".stl", read_stl}, {".obj", read_obj}, {".off", read_off},
                                                      {".ply", read_ply}, {".3mf", read_3mf}, {".amf", read_amf}};

// nullptr where none reads such files.
Reader find_reader(const std::string& path) {
  const auto* found = std::find_if(std::begin(readers), std::end(readers),
                                   [&](const auto& reader) { return ending_of(path) == reader.first; });
  return found == std::end(readers) ? nullptr : found->second;
}

Error not_readable(const std::string& path) {
  return at_file(path, "meshes are read from files that end in .stl, .obj, .off, .ply, .3mf or .amf, not '" +
                           ending_of(path) + "'; export it as one of these");
}

Result<BuiltMesh> build_from(const MeshFile& file, const Result<PolygonSoup>& soup, const char* what, bool hull) {
  if (!soup) return soup.error();
  Result<BuiltMesh> built = build_mesh(*soup, what, hull);
  if (!built) return at_file(file.path, built.error().message);
  return built;
}

}  // namespace

bool is_mesh_file(const std::string& path) {
  return find_reader(path) != nullptr;
}

Result<BuiltMesh> parse_mesh(const MeshFile& file, bool hull) {
  const Reader read = find_reader(file.path);
  if (read == nullptr) return not_readable(file.path);
  return build_from(file, read(file), "the mesh", hull);
}

Result<BuiltMesh> load_mesh(const std::string& path, bool hull) {
  // Told before a file that is none of ours is read.
  if (find_reader(path) == nullptr) return not_readable(path);
  const Result<MeshFile> file = read_input_file(path, "a mesh file");
  if (!file) return file.error();
  return parse_mesh(*file, hull);
}

Result<BuiltMesh> load_height_map(const std::string& path, const HeightMapOptions& options) {
  const Result<MeshFile> file = read_input_file(path, "a mesh file");
  if (!file) return file.error();
  return build_from(*file, read_height_map(*file, options), "the surface", false);
}

}  // namespace tenon
