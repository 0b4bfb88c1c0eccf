#include <cmath>

#include "lang/module_arguments.h"

namespace tenon::lang {

namespace {

// It makes no solid, so that it is no operand of the operation around it either.

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

}  // namespace

void add_view_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("camera"), camera);
}

}  // namespace tenon::lang
