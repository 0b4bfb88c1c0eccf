#include <cmath>
#include <filesystem>
#include <numbers>

#include "lang/color_value.h"
#include "lang/module_arguments.h"
#include "lang/source_files.h"
#include "lang/source_text.h"

namespace tenon::lang {

namespace {

// These make no solid, so that they are no operand of the operation around them either.

Rgba require_color(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const std::optional<Rgba> c = to_color(arguments[index]);
  if (!c) fail(arguments.at(index), "'" + std::string(name) + "' must be a CSS name, \"#rrggbb\" or [r, g, b]");
  return *c;
}

enum LightParameter : std::size_t {
  type,
  position,
  direction,
  angle,
  softness,
  color,
  intensity,
  fade_distance,
  radius,
  size,
  up,
  turbidity,
  turn,
  file,
  edges
};
constexpr std::string_view light_names[] = {"type",  "position",  "direction",     "angle",  "softness",
                                            "color", "intensity", "fade_distance", "radius", "size",
                                            "up",    "turbidity", "turn",          "file",   "edges"};

constexpr std::pair<std::string_view, LightKind> light_kinds[] = {
    {"point", LightKind::point},   {"directional", LightKind::directional},
    {"spot", LightKind::spot},     {"rectangle", LightKind::rectangle},
    {"sphere", LightKind::sphere}, {"environment", LightKind::environment},
    {"sky", LightKind::sky}};

LightKind require_kind(ModuleCall& call, const ModuleArguments& arguments) {
  if (!arguments.given(type)) return LightKind::point;
  const String* text = arguments[type].string();
  for (const auto& [name, kind] : light_kinds) {
    if (text && text->text() == name) return kind;
  }
  fail(arguments.given(type) ? arguments.at(type) : call.at(),
       "'type' must be \"point\", \"directional\", \"spot\", \"rectangle\", \"sphere\", \"environment\" or \"sky\"");
}

// A parameter that a light of this type knows nothing of is a mistake.
void check_parameters(const ModuleArguments& arguments, const Light& light) {
  constexpr std::string_view known[] = {"position fade_distance",  // point
                                        "direction",               // directional
                                        "position direction angle softness fade_distance",
                                        "position direction size up edges",  // rectangle
                                        "position radius",                   // sphere
                                        "turn file",                         // environment
                                        "direction turbidity"};              // sky
  const std::string_view list = known[static_cast<std::size_t>(light.kind)];
  for (std::size_t i = 0; i < std::size(light_names); ++i) {
    if (!arguments.given(i) || i == type || i == color || i == intensity) continue;
    if ((" " + std::string(list) + " ").find(" " + std::string(light_names[i]) + " ") != std::string::npos) continue;
    fail(arguments.at(i), "a light of type \"" + std::string(light_kinds[static_cast<std::size_t>(light.kind)].first) +
                              "\" has no '" + std::string(light_names[i]) + "'; it has " + std::string(list) +
                              " color intensity");
  }
}

double number(const ModuleArguments& arguments, LightParameter parameter, double fallback) {
  return arguments.given(parameter) ? require_number(arguments, parameter, light_names[parameter]) : fallback;
}

double positive(const ModuleArguments& arguments, LightParameter parameter, double fallback) {
  const double value = number(arguments, parameter, fallback);
  if (value > 0) return value;
  fail(arguments.at(parameter), "'" + std::string(light_names[parameter]) + "' must be greater than 0");
}

// The sides of a rectangle: as they are given, or of a size, the second one pointing as far up as it can. It faces
// where their cross product points.
void set_sides(const ModuleArguments& arguments, Light& light) {
  if (arguments.given(edges)) {
    const List* list = arguments[edges].list();
    const auto u = list && list->items().size() == 2 ? to_vec3(list->items()[0]) : std::nullopt;
    const auto v = u ? to_vec3(list->items()[1]) : std::nullopt;
    if (!v)
      fail(arguments.at(edges), "'edges' must be a list of the rectangle's two sides, like [[2, 0, 0], [0, 1, 0]]");
    for (const LightParameter other : {direction, size, up}) {
      if (arguments.given(other)) fail(arguments.at(other), "'edges' say all of the rectangle; leave the others out");
    }
    light.edge_u = *u;
    light.edge_v = *v;
    light.direction = cross(*u, *v);
    return;
  }
  double width = 1, height = 1;
  if (arguments.given(size)) {
    if (const double* side = arguments[size].number()) {
      width = height = *side;
    } else {
      const std::optional<Vec3> sides = to_vec3(arguments[size], 0);
      if (!sides || sides->z != 0) fail(arguments.at(size), "'size' must be a number or a list of two, like [2, 1]");
      width = sides->x;
      height = sides->y;
    }
    if (!(width > 0 && height > 0)) fail(arguments.at(size), "'size' must be greater than 0");
  }
  const Vec3 forward = normalize(light.direction);
  Vec3 upward = forward.x == 0 && forward.y == 0 ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  if (arguments.given(up)) upward = require_vec3(arguments, up, "up");
  const Vec3 across = normalize(cross(upward, forward));
  if (across == Vec3{}) fail(arguments.at(up), "'up' must not be parallel to 'direction', nor zero");
  light.edge_u = width * across;
  light.edge_v = height * cross(forward, across);
}

// Where a rectangle stands after the transformations around it; a mirror image faces the other way round.
void move_sides(ModuleCall& call, Light& light) {
  const Affine3& here = call.evaluator.world_from_here;
  const Vec3 faces = here.direction(light.direction);
  light.edge_u = here.direction(light.edge_u);
  light.edge_v = here.direction(light.edge_v);
  if (dot(cross(light.edge_u, light.edge_v), faces) < 0) std::swap(light.edge_u, light.edge_v);
  light.direction = cross(light.edge_u, light.edge_v);
  if (light.direction == Vec3{})
    fail(call.at(), "the light is flat in one direction; give it two sides, and scale it otherwise");
}

std::string environment_file(const ModuleArguments& arguments) {
  if (!arguments.given(file)) return {};
  const String* name = arguments[file].string();
  if (!name) fail(arguments.at(file), "'file' must be the name of an .exr or .hdr picture in quotes");
  const std::string found = SourceFiles::find(name->text(), arguments.at(file));
  std::error_code none;
  if (!std::filesystem::is_regular_file(found, none)) {
    fail(arguments.at(file), "there is no file '" + found + "'; name an .exr or .hdr picture of the world around");
  }
  return std::filesystem::absolute(found).lexically_normal().string();
}

std::optional<Solid> light(ModuleCall& call) {
  refuse_children(call);
  const ModuleArguments arguments(call, light_names, UnknownArgument::fail);
  const Affine3& here = call.evaluator.world_from_here;
  Light l;
  l.kind = require_kind(call, arguments);
  check_parameters(arguments, l);
  if (arguments.given(position)) l.position = require_vec3(arguments, position, "position");
  if (arguments.given(direction)) l.direction = require_vec3(arguments, direction, "direction");
  if (l.direction == Vec3{}) fail(arguments.at(direction), "'direction' must not be zero");
  if (arguments.given(angle)) {
    l.angle = require_number(arguments, angle, "angle");
    if (!(l.angle > 0 && l.angle <= 90))
      fail(arguments.at(angle), "'angle' is half the cone's opening, above 0 and up to 90");
  }
  if (arguments.given(softness)) {
    l.softness = require_number(arguments, softness, "softness");
    if (!(l.softness >= 0 && l.softness <= 1)) fail(arguments.at(softness), "'softness' must lie between 0 and 1");
  }
  if (arguments.given(color)) l.color = require_color(arguments, color, "color");
  l.intensity = number(arguments, intensity, 1);
  if (l.intensity < 0) fail(arguments.at(intensity), "'intensity' must not be negative");
  l.fade_distance = number(arguments, fade_distance, 0);
  if (l.fade_distance < 0) fail(arguments.at(fade_distance), "'fade_distance' must not be negative");
  l.radius = std::cbrt(std::fabs(here.determinant())) * positive(arguments, radius, 1);
  l.turbidity = number(arguments, turbidity, l.turbidity);
  if (!(l.turbidity >= 2 && l.turbidity <= 10)) {
    fail(arguments.at(turbidity), "'turbidity' lies between 2, a clear sky, and 10, haze");
  }
  const Vec3 ahead = here.direction({0, 1, 0});
  l.turn = number(arguments, turn, 0) + std::atan2(-ahead.x, ahead.y) * (180 / std::numbers::pi);
  l.file = environment_file(arguments);
  if (!l.file.empty()) l.file_named_at = locate(arguments.at(file));
  l.position = here.point(l.position);
  if (l.kind == LightKind::rectangle) {
    set_sides(arguments, l);
    move_sides(call, l);
  } else {
    l.direction = here.direction(l.direction);
  }
  std::vector<Light>& lights = call.evaluator.builder().model().lights;
  for (const Light& other : lights) {
    if (l.is_around() && other.is_around()) {
      fail(call.at(), "the scene has a light around it already; there is one sky or environment");
    }
  }
  lights.push_back(l);
  return std::nullopt;
}

constexpr std::string_view color_parameter[] = {"color"};

std::optional<Solid> background(ModuleCall& call) {
  refuse_children(call);
  const ModuleArguments arguments(call, color_parameter, UnknownArgument::fail);
  call.evaluator.builder().model().background = require_color(arguments, 0, "color");
  return std::nullopt;
}

std::optional<Solid> ambient(ModuleCall& call) {
  refuse_children(call);
  const ModuleArguments arguments(call, color_parameter, UnknownArgument::fail);
  Rgba c;
  if (arguments[0].number()) {
    const double grey = require_number(arguments, 0, "color");
    if (grey < 0) fail(arguments.at(0), "'color' must not be negative");
    c = {grey, grey, grey, 1};
  } else {
    c = require_color(arguments, 0, "color");
  }
  call.evaluator.builder().model().ambient = c;
  return std::nullopt;
}

}  // namespace

void add_light_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  const std::pair<const char*, BuiltinModule> modules[] = {
      {"light", light}, {"background", background}, {"ambient", ambient}};
  for (const auto& [name, module] : modules) table.emplace(symbols.intern(name), module);
}

}  // namespace tenon::lang
