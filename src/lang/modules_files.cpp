#include <cmath>
#include <filesystem>

#include "drawing/svg.h"

#include "lang/drawing_file.h"
#include "lang/failure.h"
#include "lang/flat_outline.h"
#include "lang/format.h"
#include "lang/primitive_arguments.h"
#include "lang/source_files.h"
#include "mesh/load_mesh.h"

namespace tenon::lang {

namespace {

MeshStructure mesh_structure(const ModuleArguments& arguments, std::size_t index) {
  if (!arguments.given(index)) return MeshStructure::bvh;
  const String* name = arguments[index].string();
  if (name && name->text() == "bvh") return MeshStructure::bvh;
  if (name && name->text() == "kd") return MeshStructure::kd;
  fail(arguments.at(index), "'local' must be \"bvh\" or \"kd\", the structure over the triangles of the mesh");
}

// The name of a file, found beside the one that says it; and absolute, as a statement that makes the solid again needs
// it.
struct NamedFile {
  std::string found;
  std::string absolute;
};
NamedFile require_file(ModuleCall& call, const ModuleArguments& arguments, const char* kind) {
  const String* file = arguments[0].string();
  if (!file) {
    fail(arguments.at(0), call.evaluator.environment().text(call.instantiation.name) + "() needs 'file', the name of " +
                              kind + " in quotes");
  }
  const std::string found = SourceFiles::find(file->text(), call.at());
  return {found, std::filesystem::absolute(found).lexically_normal().string()};
}

// Of a file one primitive, however often it is used: it is stored once.
template <class Load>
Solid mesh_of_file(ModuleCall& call, Place at, const NamedFile& file, const std::string& source, MeshStructure local,
                   bool hull, const Load& load) {
  Environment& environment = call.evaluator.environment();
  PrimitiveId& known = call.evaluator.imported(source);
  if (known) return call.evaluator.builder().leaf(known);
  Result<BuiltMesh> built = load();
  if (!built) throw Failure{built.error()};
  for (const std::string& note : built->notes) environment.warn(at, file.found + ": " + note);
  built->mesh.source = source;
  built->mesh.local = local;
  const Result<PrimitiveId> made = call.evaluator.builder().model().graph.primitives.add(
      *PrimitiveStore::find_kind("mesh"),
      std::vector<FieldValue>{std::make_shared<const TriangleMesh>(std::move(built->mesh)), hull});
  if (!made) {
    environment.warn(at, file.found + ": " + made.error().message);
    return Solid::nothing();
  }
  known = *made;
  return call.evaluator.builder().leaf(known);
}

std::optional<Solid> import_svg(ModuleCall& call, const ModuleArguments& arguments) {
  const NamedFile named = require_file(call, arguments, "a picture");
  SvgOptions options;
  options.dpi = number_argument(call, arguments, 8, "dpi").value_or(options.dpi);
  if (!(options.dpi > 0) || !std::isfinite(options.dpi)) fail(arguments.at(8), "'dpi' must be positive");
  options.center = arguments[7].truth();
  if (const String* layer = arguments[2].string()) options.layer = layer->text();
  if (const String* id = arguments[9].string()) options.id = id->text();
  const Result<InputFile> file = read_input_file(named.found, "a picture");
  if (!file) throw Failure{file.error()};
  Result<SvgPicture> picture = read_svg(*file, options);
  if (!picture) throw Failure{picture.error()};
  for (const std::string& note : picture->notes) {
    call.evaluator.environment().warn(arguments.at(0), named.found + ": " + note);
  }
  return flat_solid(call.evaluator, std::move(picture->outline), arguments.at(0));
}

std::optional<Solid> import(ModuleCall& call) {
  constexpr std::string_view names[] = {"file", "convexity", "layer",  "origin", "scale",
                                        "hull", "local",     "center", "dpi",    "id"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  if (const String* name = arguments[0].string(); name && ending_of(name->text()) == ".svg") {
    return import_svg(call, arguments);
  }
  if (const String* name = arguments[0].string(); name && is_drawing(name->text())) {
    DrawingRequest request = drawing_request(call, arguments, 0, 2, 3);
    request.scale = number_argument(call, arguments, 4, "scale").value_or(1);
    return shape_of_drawing(call.evaluator, request);
  }
  const NamedFile file = require_file(call, arguments, "a mesh file or a drawing");
  const bool* given_hull = arguments[5].boolean();
  if (arguments.given(5) && !given_hull) fail(arguments.at(5), "'hull' must be true or false");
  const bool hull = given_hull && *given_hull;
  const MeshStructure local = mesh_structure(arguments, 6);
  const std::string source = "import(file = " + quoted(file.absolute) + (hull ? ", hull = true" : "") +
                             (local == MeshStructure::kd ? ", local = \"kd\")" : ")");
  return mesh_of_file(call, arguments.at(0), file, source, local, hull, [&] { return load_mesh(file.found, hull); });
}

std::optional<Solid> surface(ModuleCall& call) {
  constexpr std::string_view names[] = {"file", "center", "convexity", "invert"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const NamedFile file = require_file(call, arguments, "a height map");
  const HeightMapOptions options{arguments[1].truth(), arguments[3].truth()};
  const std::string source = "surface(file = " + quoted(file.absolute) + (options.center ? ", center = true" : "") +
                             (options.invert ? ", invert = true)" : ")");
  return mesh_of_file(call, arguments.at(0), file, source, MeshStructure::bvh, false,
                      [&] { return load_height_map(file.found, options); });
}

}  // namespace

void add_file_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  for (const char* name : {"import", "import_dxf", "import_stl", "import_off"})
    table.emplace(symbols.intern(name), import);
  table.emplace(symbols.intern("surface"), surface);
}

}  // namespace tenon::lang
