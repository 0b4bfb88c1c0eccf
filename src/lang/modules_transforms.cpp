#include <cmath>
#include <utility>

#include "lang/flat_shapes.h"
#include "lang/format.h"
#include "lang/module_arguments.h"
#include "lang/resize.h"

namespace tenon::lang {

namespace {

constexpr std::string_view translate_names[] = {"v"};
constexpr std::string_view rotate_names[] = {"a", "v"};
constexpr std::string_view matrix_names[] = {"m"};
constexpr std::string_view resize_names[] = {"newsize", "auto", "convexity"};

// As OpenSCAD: what is no vector is warned of, and does nothing.
Vec3 vector_argument(ModuleCall& call, const ModuleArguments& arguments, double fallback_z, const Vec3& fallback) {
  if (const auto v = to_vec3(arguments[0], fallback_z)) return *v;
  Environment& environment = call.evaluator.environment();
  environment.warn(arguments.at(0), environment.text(call.instantiation.name) +
                                        "() takes a list of two or three numbers, not " +
                                        format_value(arguments[0], environment.symbols) + "; it does nothing");
  return fallback;
}

Affine3 translate(ModuleCall& call) {
  const ModuleArguments arguments(call, translate_names, UnknownArgument::warn);
  return Affine3::translate(vector_argument(call, arguments, 0, {}));
}

Affine3 scale(ModuleCall& call) {
  const ModuleArguments arguments(call, translate_names, UnknownArgument::warn);
  if (const double* factor = arguments[0].number(); factor && std::isfinite(*factor)) {
    return Affine3::scale({*factor, *factor, *factor});
  }
  return Affine3::scale(vector_argument(call, arguments, 1, {1, 1, 1}));
}

Affine3 mirror(ModuleCall& call) {
  const ModuleArguments arguments(call, translate_names, UnknownArgument::warn);
  return Affine3::mirror(vector_argument(call, arguments, 0, {1, 0, 0}));
}

// Angles about x, y and z; missing ones are zero.
std::optional<Vec3> euler_angles(const List& list) {
  if (list.items().size() > 3) return std::nullopt;
  Vec3 angles;
  for (std::size_t i = 0; i < list.items().size(); ++i) {
    const double* angle = list.items()[i].number();
    if (!angle || !std::isfinite(*angle)) return std::nullopt;
    angles[static_cast<int>(i)] = *angle;
  }
  return angles;
}

Affine3 rotate(ModuleCall& call) {
  const ModuleArguments arguments(call, rotate_names, UnknownArgument::warn);
  Environment& environment = call.evaluator.environment();
  if (const List* list = arguments[0].list()) {
    if (const auto angles = euler_angles(*list)) {
      if (arguments.given(1)) environment.warn(arguments.at(1), "'v' is ignored where 'a' is a list");
      return Affine3::rotate(*angles);
    }
  } else if (const double* angle = arguments[0].number(); angle && std::isfinite(*angle)) {
    if (!arguments.given(1)) return Affine3::rotate(*angle, {0, 0, 1});
    if (const auto axis = to_vec3(arguments[1], 0)) return Affine3::rotate(*angle, *axis);
    environment.warn(arguments.at(1), "'v' must be an axis of three numbers, not " +
                                          format_value(arguments[1], environment.symbols) + "; the axis is z");
    return Affine3::rotate(*angle, {0, 0, 1});
  }
  environment.warn(arguments.at(0), "rotate() takes an angle or three angles, not " +
                                        format_value(arguments[0], environment.symbols) + "; it does nothing");
  return {};
}

// Three or four rows of up to four numbers; what is missing is as in the identity. Null for anything else.
std::optional<Affine3> matrix(const Value& value) {
  const List* rows = value.list();
  if (!rows || rows->items().size() > 4) return std::nullopt;
  double m[4][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  for (std::size_t i = 0; i < rows->items().size(); ++i) {
    const List* row = rows->items()[i].list();
    if (!row || row->items().size() > 4) return std::nullopt;
    for (std::size_t j = 0; j < row->items().size(); ++j) {
      const double* number = row->items()[j].number();
      if (!number || !std::isfinite(*number)) return std::nullopt;
      m[i][j] = *number;
    }
  }
  if (m[3][0] != 0 || m[3][1] != 0 || m[3][2] != 0 || m[3][3] == 0) return std::nullopt;
  Affine3 map;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) map.m[i][j] = m[i][j] / m[3][3];
  }
  return map;
}

Affine3 multmatrix(ModuleCall& call) {
  const ModuleArguments arguments(call, matrix_names, UnknownArgument::warn);
  if (const auto map = matrix(arguments[0])) return *map;
  call.evaluator.environment().warn(
      arguments.at(0), "multmatrix() takes four rows of four numbers, the last [0, 0, 0, 1]; it does nothing");
  return {};
}

void warn_of_flattening(ModuleCall& call) {
  Environment& environment = call.evaluator.environment();
  environment.warn(call.at(),
                   environment.text(call.instantiation.name) + "() flattens its children here; they make no solid");
}

// `rotate(90); cube(3);` turns nothing. A file that a program wrote may say so of its matrices.
void warn_without_children(ModuleCall& call) {
  if (!call.instantiation.children->instantiations.empty()) return;
  Environment& environment = call.evaluator.environment();
  const std::string& name = environment.text(call.instantiation.name);
  environment.warn(call.at(), name + "() has no children and moves nothing; is there a ';' too many after it?");
}

// The children under a transform. One that flattens space leaves no solid. What finds the map is a function apart, for
// this frame stays on the stack while the children are evaluated, and they may nest deep.
template <Affine3 (*find_map)(ModuleCall&)>
std::optional<Solid> transformed(ModuleCall& call) {
  if constexpr (find_map != multmatrix) warn_without_children(call);
  const Affine3 map = find_map(call);
  ModuleEvaluator& evaluator = call.evaluator;
  const Affine3 outside = std::exchange(evaluator.world_from_here, evaluator.world_from_here * map);
  const Solids parts = evaluator.children(*call.instantiation.children, call.scope);
  evaluator.world_from_here = outside;
  const Affine3 used = are_flat(parts) ? flattened(map) : map;
  if (used.inverse()) return evaluator.builder().wrap(Transform{used}, parts);
  warn_of_flattening(call);
  return Solid::nothing();
}

// Which directions follow the one of the largest new size where their own new size is 0.
std::array<bool, 3> automatic_directions(const Value& value) {
  std::array<bool, 3> automatic{};
  if (const bool* all = value.boolean()) automatic.fill(*all);
  if (const List* list = value.list()) {
    for (std::size_t i = 0; i < std::min<std::size_t>(3, list->items().size()); ++i)
      automatic[i] = list->items()[i].truth();
  }
  return automatic;
}

Vec3 new_size(const Value& value) {
  Vec3 size;
  const List* list = value.list();
  for (std::size_t i = 0; list && i < std::min<std::size_t>(3, list->items().size()); ++i) {
    const double* number = list->items()[i].number();
    if (number && std::isfinite(*number)) size[static_cast<int>(i)] = *number;
  }
  return size;
}

std::optional<Solid> resize(ModuleCall& call) {
  const ModuleArguments arguments(call, resize_names, UnknownArgument::warn);
  ModuleEvaluator& evaluator = call.evaluator;
  const Solid whole = evaluator.builder().unite(evaluator.children(*call.instantiation.children, call.scope));
  if (whole.is_nothing()) return whole;
  Vec3 size = new_size(arguments[0]);
  std::array<bool, 3> automatic = automatic_directions(arguments[1]);
  if (whole.flat) size.z = 0, automatic[2] = false;
  const Affine3 map = resizing(evaluator, whole, size, automatic, call.at());
  return evaluator.builder().wrap(Transform{map}, {whole});
}

}  // namespace

void add_transform_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  const std::pair<const char*, BuiltinModule> modules[] = {
      {"translate", transformed<translate>}, {"scale", transformed<scale>},           {"rotate", transformed<rotate>},
      {"mirror", transformed<mirror>},       {"multmatrix", transformed<multmatrix>}, {"resize", resize},
  };
  for (const auto& [name, module] : modules) table.emplace(symbols.intern(name), module);
}

}  // namespace tenon::lang
