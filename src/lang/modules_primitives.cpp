#include <algorithm>
#include <cmath>
#include <functional>

#include "lang/facets.h"
#include "lang/failure.h"
#include "lang/field_arguments.h"
#include "lang/format.h"
#include "lang/polyhedron.h"
#include "lang/primitive_arguments.h"
#include "lang/turned_facets.h"
#include "primitive/flatness.h"

namespace tenon::lang {

namespace {

using Faces = std::vector<std::vector<std::size_t>>;

Solid make_polyhedron(ModuleCall& call, std::vector<Plane> planes) {
  return make_primitive(call, "convex_polyhedron", {FieldValue(std::move(planes))});
}

// What encloses a profile right of the axis, from below upwards, when it is turned in facets.
// @param find_planes  gives those of the polyhedron, where there are few
Solid make_faceted(ModuleCall& call, const std::function<std::vector<Plane>()>& find_planes,
                   const std::vector<Vec2>& profile, int facets) {
  if (static_cast<std::size_t>(facets) * (profile.size() - 1) + 2 <= most_planes) {
    return make_polyhedron(call, find_planes());
  }
  std::vector<OutlineCorner> loop{{0, profile.front().y, 0}};
  for (const Vec2& p : profile) loop.push_back({p.x, p.y, 0});
  loop.push_back({0, profile.back().y, 0});
  std::vector<double> angles;
  for (int i = 0; i < facets; ++i) angles.push_back(360.0 * i / facets);
  return turned_in_facets(call.evaluator, {{loop}}, 0, angles, call.at());
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
  return make_faceted(
      call, [&] { return faceted_sphere(r, facets); }, sphere_profile(r, facets), facets);
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
  if (facets > 0 && sound) {
    const double bottom = center ? -h / 2 : 0;
    const auto find_planes = [&] { return faceted_cone(h, r1, r2, bottom, facets); };
    return make_faceted(call, find_planes, {{r1, bottom}, {r2, bottom + h}}, facets);
  }
  if (r1 == r2) return make_primitive(call, "cylinder", {h, r1, center});
  return make_primitive(call, "cone", {h, r1, r2, center});
}

// Points as a list of vectors; fails where it is none.
std::vector<Vec3> require_points(const ModuleArguments& arguments, std::size_t index, const std::string& module) {
  const List* list = arguments[index].list();
  if (!list) fail(arguments.at(index), module + "() needs 'points', a list of [x, y, z]");
  std::vector<Vec3> points;
  for (const Value& item : list->items()) {
    const auto point = to_vec3(item);
    if (!point) {
      fail(arguments.at(index),
           "point " + std::to_string(points.size()) + " of " + module + "() is no list of three finite numbers");
    }
    points.push_back(*point);
  }
  return points;
}

Faces require_faces(const ModuleArguments& arguments, std::size_t index) {
  const List* list = arguments[index].list();
  if (!list) fail(arguments.at(index), "polyhedron() needs 'faces', a list of lists of indices into 'points'");
  Faces faces;
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

std::optional<Solid> polyhedron_of(ModuleCall& call, const std::vector<Vec3>& points, const Faces& faces) {
  warn_of_children(call);
  return polyhedron_solid(call.evaluator, points, faces, call.at());
}

std::optional<Solid> polyhedron(ModuleCall& call) {
  constexpr std::string_view names[] = {"points", "faces", "convexity", "triangles"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const std::vector<Vec3> points = require_points(arguments, 0, "polyhedron");
  const bool old = !arguments.given(1) && arguments.given(3);
  if (old) call.evaluator.environment().warn(arguments.at(3), "'triangles' is deprecated; write 'faces'");
  return polyhedron_of(call, points, require_faces(arguments, old ? 3 : 1));
}

// The faces of eight vertices, those without a corner of their own left out. Fails where one is not flat.
Faces faces_of_arb8(const std::vector<Vec3>& points, Place at) {
  constexpr std::size_t corners[6][4] = {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                         {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  Faces faces;
  for (const auto& quad : corners) {
    std::vector<std::size_t> face;
    std::vector<Vec3> loop;
    for (const std::size_t i : quad) {
      // Vertices in one place are one.
      const auto first = static_cast<std::size_t>(std::find(points.begin(), points.end(), points[i]) - points.begin());
      if (std::find(face.begin(), face.end(), first) != face.end()) continue;
      face.push_back(first);
      loop.push_back(points[first]);
    }
    if (face.size() < 3) continue;
    if (const auto bent = find_deviation({&loop, 1})) {
      std::string names;
      for (const std::size_t i : quad) names += (names.empty() ? "" : ", ") + std::to_string(i);
      fail(at, "arb8() with the face of points " + names + " is not flat: they deviate from a plane by " +
                   format_number(*bent) + "; move one of them, or use polyhedron() with triangles");
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

std::optional<Solid> arb8(ModuleCall& call) {
  constexpr std::string_view names[] = {"points"};
  const ModuleArguments arguments(call, names, UnknownArgument::fail);
  const std::vector<Vec3> points = require_points(arguments, 0, "arb8");
  if (points.size() != 8) {
    fail(arguments.at(0), "arb8() needs eight points, four around one face and the four opposite; these are " +
                              std::to_string(points.size()));
  }
  return polyhedron_of(call, points, faces_of_arb8(points, arguments.at(0)));
}

// A sphere, stretched.
std::optional<Solid> ellipsoid(ModuleCall& call) {
  constexpr std::string_view names[] = {"r"};
  const ModuleArguments arguments(call, names, UnknownArgument::fail);
  const Vec3 r = arguments.given(0) ? require_vec3(arguments, 0, "r") : Vec3{1, 1, 1};
  for (int axis = 0; axis < 3; ++axis) {
    if (r[axis] > 0) continue;
    call.evaluator.environment().warn(call.at(),
                                      "ellipsoid with a semi-axis of " + format_number(r[axis]) + " has no volume");
    return Solid::nothing();
  }
  return call.evaluator.builder().wrap(Transform{Affine3::scale(r)}, {make_primitive(call, "sphere", {1.0})});
}

// Of ellipses in the same proportions a cone or cylinder, stretched; where its axis leans, sheared.
std::optional<Solid> truncated_cone(ModuleCall& call) {
  constexpr std::string_view names[] = {"h", "a1", "b1", "a2", "b2"};
  const ModuleArguments arguments(call, names, UnknownArgument::fail);
  Vec3 axis{0, 0, 1};
  if (arguments.given(0)) {
    axis = arguments[0].number() ? Vec3{0, 0, require_number(arguments, 0, "h")} : require_vec3(arguments, 0, "h");
  }
  const PrimitiveKind& kind = *PrimitiveStore::find_kind("truncated_cone");
  double radii[4];
  for (std::size_t i = 0; i < 4; ++i) radii[i] = std::get<double>(require_field(arguments, i + 1, kind.fields[i + 1]));
  const auto [a1, b1, a2, b2] = radii;

  const double a = std::fmax(a1, a2), b = std::fmax(b1, b2);
  const bool proportional = a1 * b2 == a2 * b1 && a > 0 && b > 0 && axis.z > 0;
  Affine3 map;
  Solid solid;
  if (proportional) {
    map = Affine3::scale({1, b / a, 1});
    solid = a1 == a2 ? make_primitive(call, "cylinder", {axis.z, a1, false})
                     : make_primitive(call, "cone", {axis.z, a1, a2, false});
  } else {
    solid = make_primitive(call, kind.name, {axis.z, a1, b1, a2, b2});
  }
  map.m[0][2] = axis.x / axis.z;
  map.m[1][2] = axis.y / axis.z;
  return map == Affine3{} ? solid : call.evaluator.builder().wrap(Transform{map}, {solid});
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
  table.emplace(symbols.intern("arb8"), arb8);
  table.emplace(symbols.intern("ellipsoid"), ellipsoid);
  table.emplace(symbols.intern("truncated_cone"), truncated_cone);
  for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
    table.emplace(symbols.intern(kind.scad_name), primitive_of_kind);
  }
}

}  // namespace tenon::lang
