#include <cmath>

#include "lang/facets.h"
#include "lang/failure.h"
#include "lang/format.h"
#include "lang/polyhedron.h"
#include "lang/primitive_arguments.h"
#include "mesh/build_mesh.h"

namespace tenon::lang {

namespace {

Solid make_polyhedron(ModuleCall& call, std::vector<Plane> planes) {
  return make_primitive(call, "convex_polyhedron", {FieldValue(std::move(planes))});
}

std::optional<Solid> cube(ModuleCall& call) {
  constexpr std::string_view names[] = {"size", "center"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  Vec3 size{1, 1, 1};
  if (const double* edge = arguments[0].number()) {
    size = {*edge, *edge, *edge};
  } else if (const auto edges = to_vec3(arguments[0])) {
    size = *edges;
  } else if (arguments.given(0)) {
    Environment& environment = call.evaluator.environment();
    environment.warn(arguments.at(0), "'size' must be a number or a list of three, not " +
                                          format_value(arguments[0], environment.symbols) + "; it is 1");
  }
  const bool* center = arguments[1].boolean();
  return make_primitive(call, "cube", {size, center && *center});
}

std::optional<Solid> sphere(ModuleCall& call) {
  constexpr std::string_view names[] = {"r", "d"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const double r = radius_argument(call, arguments, 0, 1, "r").value_or(1);
  const int facets = facet_count(call.evaluator, r);
  if (facets == 0 || !(r > 0) || !std::isfinite(r)) return make_primitive(call, "sphere", {r});
  return make_polyhedron(call, faceted_sphere(r, facets));
}

std::optional<Solid> cylinder(ModuleCall& call) {
  constexpr std::string_view names[] = {"h", "r1", "r2", "center", "r", "d", "d1", "d2"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const double h = number_argument(call, arguments, 0, "h").value_or(1);
  const auto both = radius_argument(call, arguments, 4, 5, "r");
  const auto lower = radius_argument(call, arguments, 1, 6, "r1");
  const auto upper = radius_argument(call, arguments, 2, 7, "r2");
  if (both && (lower || upper)) {
    call.evaluator.environment().warn(call.at(), "'r' or 'd' stands beside radii of the ends, which go first");
  }
  const double r1 = lower ? *lower : both.value_or(1), r2 = upper ? *upper : both.value_or(1);
  const bool* given_center = arguments[3].boolean();
  const bool center = given_center && *given_center;
  const int facets = facet_count(call.evaluator, std::fmax(r1, r2));
  const bool sound = h > 0 && r1 >= 0 && r2 >= 0 && r1 + r2 > 0 && std::isfinite(h + r1 + r2);
  if (facets > 0 && sound) return make_polyhedron(call, faceted_cone(h, r1, r2, center ? -h / 2 : 0, facets));
  if (r1 == r2) return make_primitive(call, "cylinder", {h, r1, center});
  return make_primitive(call, "cone", {h, r1, r2, center});
}

// Points as a list of vectors; fails where it is none.
std::vector<Vec3> require_points(const ModuleArguments& arguments, std::size_t index) {
  const List* list = arguments[index].list();
  if (!list) fail(arguments.at(index), "polyhedron() needs 'points', a list of [x, y, z]");
  std::vector<Vec3> points;
  for (const Value& item : list->items()) {
    const auto point = to_vec3(item);
    if (!point) {
      fail(arguments.at(index),
           "point " + std::to_string(points.size()) + " of the polyhedron is no list of three finite numbers");
    }
    points.push_back(*point);
  }
  return points;
}

std::vector<std::vector<std::size_t>> require_faces(const ModuleArguments& arguments, std::size_t index) {
  const List* list = arguments[index].list();
  if (!list) fail(arguments.at(index), "polyhedron() needs 'faces', a list of lists of indices into 'points'");
  std::vector<std::vector<std::size_t>> faces;
  for (const Value& item : list->items()) {
    std::vector<std::size_t>& face = faces.emplace_back();
    const List* corners = item.list();
    for (std::size_t i = 0; corners && i < corners->items().size(); ++i) {
      const double* number = corners->items()[i].number();
      if (!number || !(*number >= 0 && *number < 1e9)) corners = nullptr;
      if (corners) face.push_back(static_cast<std::size_t>(*number));
    }
    if (!corners) {
      fail(arguments.at(index),
           "face " + std::to_string(faces.size() - 1) + " of the polyhedron is no list of indices from 0");
    }
  }
  return faces;
}

constexpr std::size_t most_planes = 32;

PolygonSoup soup_of(const std::vector<Vec3>& points, const std::vector<std::vector<std::size_t>>& faces) {
  PolygonSoup soup;
  soup.points = points;
  for (const std::vector<std::size_t>& face : faces) {
    soup.add_face(std::vector<std::uint32_t>(face.begin(), face.end()));
  }
  return soup;
}

std::optional<Solid> make_mesh(ModuleCall& call, const PolygonSoup& soup) {
  Result<BuiltMesh> built = build_mesh(soup, "the polyhedron", false);
  if (!built) fail(call.at(), built.error().message);
  for (const std::string& note : built->notes) call.evaluator.environment().warn(call.at(), note);
  return make_primitive(call, "mesh", {std::make_shared<const TriangleMesh>(std::move(built->mesh)), false});
}

std::optional<Solid> polyhedron(ModuleCall& call) {
  constexpr std::string_view names[] = {"points", "faces", "convexity", "triangles"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const std::vector<Vec3> points = require_points(arguments, 0);
  const bool old = !arguments.given(1) && arguments.given(3);
  if (old) call.evaluator.environment().warn(arguments.at(3), "'triangles' is deprecated; write 'faces'");
  const std::vector<std::vector<std::size_t>> faces = require_faces(arguments, old ? 3 : 1);
  auto result = planes_of(points, faces);
  const auto* planes = std::get_if<0>(&result);
  const bool is_general = !planes && std::get<1>(result).is_general;
  // The time of every ray grows with the number of planes, of a mesh's with its logarithm.
  if (is_general || (planes && planes->size() > most_planes)) return make_mesh(call, soup_of(points, faces));
  if (const auto* bad = std::get_if<BadPolyhedron>(&result)) {
    if (!bad->empty) fail(call.at(), bad->message);
    call.evaluator.environment().warn(call.at(), bad->message);
    return Solid::nothing();
  }
  return make_polyhedron(call, std::get<0>(std::move(result)));
}

std::vector<Plane> require_planes(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const std::string message =
      "'" + std::string(name) + "' must be a list of planes [nx, ny, nz, d], where n.p <= d inside";
  const List* list = arguments[index].list();
  if (!list) fail(arguments.at(index), message);
  std::vector<Plane> planes;
  for (const Value& item : list->items()) {
    double numbers[4] = {};
    const List* plane = item.list();
    if (!plane || plane->items().size() != 4) fail(arguments.at(index), message);
    for (std::size_t i = 0; i < 4; ++i) {
      const double* number = plane->items()[i].number();
      if (!number || !std::isfinite(*number)) fail(arguments.at(index), message);
      numbers[i] = *number;
    }
    planes.push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
  }
  return planes;
}

Outline require_outline(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const std::string message = "'" + std::string(name) +
                              "' must be a list of loops, each a list of corners [x, y] or [x, y, bulge], where the "
                              "bulge of an arc to the next corner is the tangent of a quarter of its angle";
  const List* list = arguments[index].list();
  if (!list) fail(arguments.at(index), message);
  Outline outline;
  for (const Value& item : list->items()) {
    const List* corners = item.list();
    if (!corners) fail(arguments.at(index), message);
    auto& loop = outline.loops.emplace_back();
    for (const Value& corner : corners->items()) {
      const auto numbers = to_vec3(corner, 0);
      if (!numbers) fail(arguments.at(index), message);
      loop.push_back({numbers->x, numbers->y, numbers->z});
    }
  }
  return outline;
}

// The value of a field, of the type of its fallback.
FieldValue require_field(const ModuleArguments& arguments, std::size_t index, const FieldInfo& field) {
  if (!arguments.given(index)) return field.fallback;
  if (std::holds_alternative<double>(field.fallback)) return require_number(arguments, index, field.name);
  if (std::holds_alternative<Vec3>(field.fallback)) return require_vec3(arguments, index, field.name);
  if (std::holds_alternative<std::vector<Plane>>(field.fallback)) return require_planes(arguments, index, field.name);
  if (std::holds_alternative<Outline>(field.fallback)) return require_outline(arguments, index, field.name);
  const bool* truth = arguments[index].boolean();
  if (!truth) fail(arguments.at(index), "'" + std::string(field.name) + "' must be true or false");
  return *truth;
}

// Tenon's own primitives: their parameters are the fields of their kinds.
std::optional<Solid> primitive_of_kind(ModuleCall& call) {
  const std::string& name = call.evaluator.environment().text(call.instantiation.name);
  const PrimitiveKind* kind = nullptr;
  for (const PrimitiveKind& candidate : PrimitiveStore::kinds()) {
    if (candidate.scad_name == name) kind = &candidate;
  }
  std::vector<std::string_view> names;
  for (const FieldInfo& field : kind->fields) names.push_back(field.name);
  const ModuleArguments arguments(call, names, UnknownArgument::fail);
  std::vector<FieldValue> values;
  for (std::size_t i = 0; i < names.size(); ++i) values.push_back(require_field(arguments, i, kind->fields[i]));
  return make_primitive(call, kind->name, values);
}

}  // namespace

void add_primitive_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  // OpenSCAD's own have parameters beyond their fields, such as diameters.
  table.emplace(symbols.intern("cube"), cube);
  table.emplace(symbols.intern("sphere"), sphere);
  table.emplace(symbols.intern("cylinder"), cylinder);
  table.emplace(symbols.intern("polyhedron"), polyhedron);
  for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
    table.emplace(symbols.intern(kind.scad_name), primitive_of_kind);
  }
}

}  // namespace tenon::lang
