#include <algorithm>
#include <cmath>

#include "lang/drawing_file.h"
#include "lang/facets.h"
#include "lang/flat_shapes.h"
#include "lang/format.h"
#include "lang/primitive_arguments.h"
#include "lang/turned_shapes.h"
#include "lang/twisted_shapes.h"
#include "math/vec2.h"

namespace tenon::lang {

namespace {

Solid make_flat(ModuleCall& call, std::string_view kind, const std::vector<FieldValue>& values) {
  Solid shape = make_primitive(call, kind, values);
  shape.flat = true;
  return shape;
}

Solid make_polygon(ModuleCall& call, Outline outline) {
  return make_flat(call, "prism", {std::move(outline), 1.0, false, 1.0});
}

std::optional<Solid> circle(ModuleCall& call) {
  constexpr std::string_view names[] = {"r", "d"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const double r = radius_argument(call, arguments, 0, 1, "r").value_or(1);
  const int facets = facet_count(call.evaluator, r);
  if (facets == 0 || !(r > 0) || !std::isfinite(r)) return make_flat(call, "cylinder", {1.0, r, false});
  Outline outline;
  auto& loop = outline.loops.emplace_back();
  for (int i = 0; i < facets; ++i) {
    const double angle = 360.0 * i / facets;
    loop.push_back({r * cos_degrees(angle), r * sin_degrees(angle), 0});
  }
  return make_polygon(call, std::move(outline));
}

std::optional<Solid> square(ModuleCall& call) {
  constexpr std::string_view names[] = {"size", "center"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  Vec3 size{1, 1, 1};
  if (const double* edge = arguments[0].number()) {
    size = {*edge, *edge, 1};
  } else if (const auto edges = to_vec3(arguments[0], 1)) {
    size = {edges->x, edges->y, 1};
  } else if (arguments.given(0)) {
    Environment& environment = call.evaluator.environment();
    environment.warn(arguments.at(0), "'size' must be a number or a list of two, not " +
                                          format_value(arguments[0], environment.symbols) + "; it is 1");
  }
  const Solid shape = make_flat(call, "cube", {size, false});
  const bool* center = arguments[1].boolean();
  if (!center || !*center) return shape;
  return call.evaluator.builder().wrap(Transform{Affine3::translate({-size.x / 2, -size.y / 2, 0})}, {shape});
}

std::vector<OutlineCorner> require_corners(const ModuleArguments& arguments) {
  const List* list = arguments[0].list();
  if (!list) fail(arguments.at(0), "polygon() needs 'points', a list of [x, y]");
  std::vector<OutlineCorner> corners;
  for (const Value& item : list->items()) {
    const auto point = to_vec3(item, 0);
    if (!point) {
      fail(arguments.at(0),
           "point " + std::to_string(corners.size()) + " of the polygon is no list of two finite numbers");
    }
    corners.push_back({point->x, point->y, 0});
  }
  return corners;
}

// The points that a path names; null where it is no list of indices.
std::optional<std::vector<OutlineCorner>> path_of(const Value& value, const std::vector<OutlineCorner>& corners) {
  const List* list = value.list();
  if (!list) return std::nullopt;
  std::vector<OutlineCorner> loop;
  for (const Value& item : list->items()) {
    const double* index = item.number();
    if (!index || !(*index >= 0 && *index < static_cast<double>(corners.size()))) return std::nullopt;
    loop.push_back(corners[static_cast<std::size_t>(*index)]);
  }
  return loop;
}

std::optional<Solid> polygon(ModuleCall& call) {
  constexpr std::string_view names[] = {"points", "paths", "convexity"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const std::vector<OutlineCorner> corners = require_corners(arguments);
  Outline outline;
  if (!arguments.given(1)) {
    outline.loops.push_back(corners);
  } else {
    const List* paths = arguments[1].list();
    // One path may stand by itself.
    const bool single = paths && !paths->items().empty() && paths->items().front().number();
    const std::size_t count = single ? 1 : paths ? paths->items().size() : 0;
    if (!paths) fail(arguments.at(1), "'paths' must be a list of lists of indices into 'points'");
    for (std::size_t i = 0; i < count; ++i) {
      auto loop = path_of(single ? arguments[1] : paths->items()[i], corners);
      if (!loop) {
        fail(arguments.at(1), "path " + std::to_string(i) + " of the polygon is no list of indices from 0 to " +
                                  std::to_string(corners.size()) + " - 1");
      }
      outline.loops.push_back(std::move(*loop));
    }
  }
  // As OpenSCAD: loops of fewer corners enclose nothing.
  std::erase_if(outline.loops, [](const auto& loop) { return loop.size() < 3; });
  if (outline.loops.empty()) {
    call.evaluator.environment().warn(call.at(), "a polygon of fewer than three points encloses nothing");
    return Solid::nothing();
  }
  return make_polygon(call, std::move(outline));
}

// A number for both directions, or a list of two.
Vec2 require_scale(const ModuleArguments& arguments, std::size_t index) {
  if (!arguments.given(index)) return {1, 1};
  const double* number = arguments[index].number();
  const auto two = to_vec3(arguments[index], 1);
  if (!number && !two) fail(arguments.at(index), "'scale' must be a number or a list of two");
  const Vec2 scale = number ? Vec2{*number, *number} : Vec2{two->x, two->y};
  if (!(scale.x >= 0 && scale.y >= 0) || !std::isfinite(scale.x + scale.y)) {
    fail(arguments.at(index), "'scale' must be at least 0");
  }
  return scale;
}

// What is extruded: the children, or a drawing. Its layer and origin follow its file among the arguments.
Solid extruded_shape(ModuleCall& call, const ModuleArguments& arguments, std::size_t file) {
  if (!arguments.given(file)) return flat_children(call);
  return shape_of_drawing(call.evaluator, drawing_request(call, arguments, file, file + 1, file + 2));
}

std::optional<Solid> linear_extrude(ModuleCall& call) {
  constexpr std::string_view names[] = {"height", "center",   "convexity", "twist", "slices",
                                        "scale",  "segments", "file",      "layer", "origin"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const double twist = number_argument(call, arguments, 3, "twist").value_or(0);
  const double* slices = arguments[4].number();
  const double height = number_argument(call, arguments, 0, "height").value_or(100);
  const Vec2 scale = require_scale(arguments, 5);
  const bool* center = arguments[1].boolean();
  Solid shape = extruded_shape(call, arguments, 7);
  if (shape.is_nothing()) return shape;
  if (!(height > 0) || !std::isfinite(height)) {
    call.evaluator.environment().warn(call.at(),
                                      "linear_extrude() with height = " + format_number(height) + " has no volume");
    return Solid::nothing();
  }
  if (twist != 0 || scale.x != scale.y) {
    if (slices && twist != 0 && *slices < facets_threshold) {
      call.evaluator.environment().warn(arguments.at(4), "linear_extrude() is smooth here; 'slices' is ignored");
    }
    shape = twisted(call.evaluator, shape, {twist, scale.x, scale.y}, call.at());
  } else if (scale.x != 1) {
    shape = tapered(call.evaluator, shape, scale.x, call.at());
  }
  Affine3 stretch = Affine3::scale({1, 1, height});
  if (center && *center) stretch.m[2][3] = -height / 2;
  Solid solid = call.evaluator.builder().wrap(Transform{stretch}, {shape});
  solid.flat = false;
  return solid;
}

std::optional<Solid> rotate_extrude(ModuleCall& call) {
  constexpr std::string_view names[] = {"angle", "convexity", "file", "layer", "origin", "scale"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  double angle = number_argument(call, arguments, 0, "angle").value_or(360);
  const Solid shape = extruded_shape(call, arguments, 2);
  if (shape.is_nothing()) return shape;
  if (angle == 0) {
    call.evaluator.environment().warn(call.at(), "rotate_extrude() with angle = 0 has no volume");
    return Solid::nothing();
  }
  if (!std::isfinite(angle)) {
    call.evaluator.environment().warn(arguments.at(0),
                                      "rotate_extrude() goes all around with angle = " + format_number(angle));
    angle = 360;
  }
  return turned(call.evaluator, shape, angle, call.at());
}

}  // namespace

void add_plane_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  const std::pair<const char*, BuiltinModule> modules[] = {{"circle", circle},
                                                           {"square", square},
                                                           {"polygon", polygon},
                                                           {"linear_extrude", linear_extrude},
                                                           {"rotate_extrude", rotate_extrude},
                                                           // Names of before 2011.
                                                           {"dxf_linear_extrude", linear_extrude},
                                                           {"dxf_rotate_extrude", rotate_extrude}};
  for (const auto& [name, module] : modules) table.emplace(symbols.intern(name), module);
}

}  // namespace tenon::lang
