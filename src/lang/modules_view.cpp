#include <array>
#include <cmath>
#include <numbers>

#include "lang/module_arguments.h"

namespace tenon::lang {

namespace {

// These make no solid, so that they are no operand of the operation around them either.

enum CameraParameter : std::size_t { from, at, up, fov, orthographic, aperture, fstop, focus };
constexpr std::string_view camera_names[] = {"from", "at", "up", "fov", "orthographic", "aperture", "fstop", "focus"};

// Width of the film that f-stops are reckoned for, in millimetres: the usual 36 x 24. The scene's unit is taken for
// one.
constexpr double film_width = 36;

void set_lens(const ModuleArguments& arguments, Camera& c) {
  if (arguments.given(aperture) && arguments.given(fstop)) {
    fail(arguments.at(fstop), "a lens is given by 'aperture' or by 'fstop'; give one of the two");
  }
  if (arguments.given(aperture)) {
    c.aperture = require_number(arguments, aperture, "aperture");
    if (c.aperture < 0) fail(arguments.at(aperture), "'aperture' is the diameter of the lens; it must not be negative");
  }
  if (arguments.given(fstop)) {
    const double stop = require_number(arguments, fstop, "fstop");
    if (!(stop > 0)) fail(arguments.at(fstop), "'fstop' must be above 0; smaller stops blur more");
    c.aperture = film_width / 2 / std::tan(c.fov * (std::numbers::pi / 360)) / stop;
  }
  if (c.aperture > 0 && c.projection == Projection::orthographic) {
    fail(arguments.at(orthographic), "parallel rays pass no lens; leave 'aperture' out, or 'orthographic'");
  }
  if (!arguments.given(focus)) return;
  if (arguments[focus].number()) {
    c.focus = require_number(arguments, focus, "focus");
  } else {
    c.focus = dot(require_vec3(arguments, focus, "focus") - c.from, normalize(c.at - c.from));
  }
  if (!(*c.focus > 0))
    fail(arguments.at(focus), "'focus' must be a distance above 0, or a point in front of the camera");
}

std::optional<Solid> camera(ModuleCall& call) {
  refuse_children(call);
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
  set_lens(arguments, c);
  const double distance = length(c.at - c.from);
  c.from = here.point(c.from);
  c.at = here.point(c.at);
  // A lens grows with the frame it stands in.
  const double growth = length(c.at - c.from) / distance;
  c.aperture *= growth;
  if (c.focus) *c.focus *= growth;
  c.up = here.direction(c.up);
  model.camera = c;
  return std::nullopt;
}

enum SectionParameter : std::size_t { normal, d, planes };
constexpr std::string_view section_names[] = {"normal", "d", "planes"};

// The plane of the world that is normal·p = d in the frame of a call.
SectionPlane placed(const Affine3& world_from_here, SectionPlane plane) {
  const std::optional<Affine3> here_from_world = world_from_here.inverse();
  if (!here_from_world) return plane;
  if (plane.d) *plane.d -= dot(plane.normal, here_from_world->translation());
  plane.normal = here_from_world->transposed_direction(plane.normal);
  return plane;
}

SectionPlane require_plane(const ModuleArguments& arguments, const Value& value) {
  const List* list = value.list();
  std::array<double, 4> n{};
  const std::size_t count = list ? list->items().size() : 0;
  bool good = count == 3 || count == 4;
  for (std::size_t i = 0; good && i < count; ++i) {
    const double* number = list->items()[i].number();
    good = number && std::isfinite(*number);
    if (good) n[i] = *number;
  }
  const Vec3 direction{n[0], n[1], n[2]};
  if (!good || direction == Vec3{}) {
    fail(arguments.at(planes), "'planes' must be a list of planes [nx, ny, nz, d], like [[1, 0, 0, 5], [0, -1, 0, 0]]");
  }
  return {direction, count == 4 ? std::optional(n[3]) : std::nullopt};
}

std::optional<Solid> section(ModuleCall& call) {
  refuse_children(call);
  const ModuleArguments arguments(call, section_names, UnknownArgument::fail);
  SectionCut cut;
  if (arguments.given(planes)) {
    if (arguments.given(normal) || arguments.given(d)) {
      fail(arguments.at(planes), "a section is given by 'normal' and 'd', or by 'planes'; give one of the two");
    }
    const List* list = arguments[planes].list();
    if (!list || list->items().empty()) require_plane(arguments, Value());
    for (const Value& item : list->items()) cut.planes.push_back(require_plane(arguments, item));
  } else {
    SectionPlane plane{{0, -1, 0}, std::nullopt};
    if (arguments.given(normal)) plane.normal = require_vec3(arguments, normal, "normal");
    if (plane.normal == Vec3{})
      fail(arguments.at(normal), "'normal' must not be zero; it points to what is taken away");
    if (arguments.given(d)) plane.d = require_number(arguments, d, "d");
    cut.planes.push_back(plane);
  }
  for (SectionPlane& plane : cut.planes) plane = placed(call.evaluator.world_from_here, plane);
  call.evaluator.builder().model().section.push_back(std::move(cut));
  return std::nullopt;
}

}  // namespace

void add_view_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("camera"), camera);
  table.emplace(symbols.intern("section"), section);
}

}  // namespace tenon::lang
