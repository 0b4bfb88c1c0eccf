#include <cmath>

#include "lang/color_value.h"
#include "lang/module_arguments.h"

namespace tenon::lang {

namespace {

// These make no solid, so that they are no operand of the operation around them either.

Rgba require_color(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const std::optional<Rgba> c = to_color(arguments[index]);
  if (!c) fail(arguments.at(index), "'" + std::string(name) + "' must be a CSS name, \"#rrggbb\" or [r, g, b]");
  return *c;
}

enum CameraParameter : std::size_t { from, at, up, fov, orthographic };
constexpr std::string_view camera_names[] = {"from", "at", "up", "fov", "orthographic"};

std::optional<Solid> camera(ModuleCall& call) {
  const ModuleArguments arguments(call, camera_names, UnknownArgument::fail);
  Model& model = call.evaluator.builder().model();
  if (model.camera) call.evaluator.environment().warn(call.at(), "there is more than one camera; the last one holds");
  const Affine3& here = call.evaluator.world_from_here;
  Camera c;
  if (arguments.given(from)) c.from = require_vec3(arguments, from, "from");
  if (arguments.given(at)) c.at = require_vec3(arguments, at, "at");
  if (arguments.given(up)) c.up = require_vec3(arguments, up, "up");
  if (c.from == c.at) fail(call.at(), "the camera stands where it looks; 'from' and 'at' must differ");
  if (c.up == Vec3{}) fail(arguments.at(up), "'up' must not be zero");
  if (arguments.given(fov) && arguments.given(orthographic)) {
    fail(arguments.at(orthographic), "a camera is either perspective, by 'fov', or orthographic; give one of the two");
  }
  if (arguments.given(fov)) {
    c.fov = require_number(arguments, fov, "fov");
    if (!(c.fov > 0 && c.fov < 180)) fail(arguments.at(fov), "'fov' must lie between 0 and 180 degrees");
  }
  if (arguments.given(orthographic)) {
    c.projection = Projection::orthographic;
    c.width = require_number(arguments, orthographic, "orthographic");
    if (!(c.width > 0))
      fail(arguments.at(orthographic), "'orthographic' is the width of the picture; it must be above 0");
  }
  c.from = here.point(c.from);
  c.at = here.point(c.at);
  c.up = here.direction(c.up);
  model.camera = c;
  return std::nullopt;
}

enum LightParameter : std::size_t { type, position, direction, angle, softness, color, intensity };
constexpr std::string_view light_names[] = {"type", "position", "direction", "angle", "softness", "color", "intensity"};

LightKind require_kind(ModuleCall& call, const ModuleArguments& arguments) {
  const String* text = arguments[type].string();
  const std::string kind = text ? text->text() : "";
  if (kind == "point" || !arguments.given(type)) return LightKind::point;
  if (kind == "directional") return LightKind::directional;
  if (kind == "spot") return LightKind::spot;
  if (kind == "area" || kind == "environment") {
    fail(arguments.at(type),
         "a light of type \"" + kind + "\" is not supported yet; use \"point\", \"directional\" or \"spot\"");
  }
  fail(arguments.given(type) ? arguments.at(type) : call.at(), "'type' must be \"point\", \"directional\" or \"spot\"");
}

std::optional<Solid> light(ModuleCall& call) {
  const ModuleArguments arguments(call, light_names, UnknownArgument::fail);
  const Affine3& here = call.evaluator.world_from_here;
  Light l;
  l.kind = require_kind(call, arguments);
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
  if (arguments.given(intensity)) {
    l.intensity = require_number(arguments, intensity, "intensity");
    if (l.intensity < 0) fail(arguments.at(intensity), "'intensity' must not be negative");
  }
  l.position = here.point(l.position);
  l.direction = here.direction(l.direction);
  call.evaluator.builder().model().lights.push_back(l);
  return std::nullopt;
}

constexpr std::string_view color_parameter[] = {"color"};

std::optional<Solid> background(ModuleCall& call) {
  const ModuleArguments arguments(call, color_parameter, UnknownArgument::fail);
  call.evaluator.builder().model().background = require_color(arguments, 0, "color");
  return std::nullopt;
}

std::optional<Solid> ambient(ModuleCall& call) {
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

void add_view_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  const std::pair<const char*, BuiltinModule> modules[] = {
      {"camera", camera}, {"light", light}, {"background", background}, {"ambient", ambient}};
  for (const auto& [name, module] : modules) table.emplace(symbols.intern(name), module);
}

}  // namespace tenon::lang
