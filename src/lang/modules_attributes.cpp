#include <cmath>

#include "lang/color_value.h"
#include "lang/format.h"
#include "lang/material_presets.h"
#include "lang/module_arguments.h"
#include "tenon/math/rounding.h"

namespace tenon::lang {

namespace {

constexpr std::string_view color_names[] = {"c", "alpha"};

Solids children_of(ModuleCall& call) {
  return call.evaluator.children(*call.instantiation.children, call.scope);
}

// OpenSCAD's own .csg files say "no colour" with negative components.
bool is_no_color(const Rgba& c) {
  return c.r < 0 || c.g < 0 || c.b < 0;
}

// The colour of a call; null, with a warning, where it is none.
std::optional<Rgba> color_of(ModuleCall& call) {
  const ModuleArguments arguments(call, color_names, UnknownArgument::warn);
  Environment& environment = call.evaluator.environment();
  std::optional<Rgba> c = to_color(arguments[0]);
  if (!c || is_no_color(*c)) {
    if (!c && arguments.given(0)) {
      environment.warn(arguments.at(0), "there is no colour " + format_value(arguments[0], environment.symbols) +
                                            "; give a CSS name, \"#rrggbb\" or [r, g, b]; it is ignored");
    }
    if (arguments.given(1)) environment.warn(arguments.at(1), "'alpha' is ignored where no colour is given");
    return std::nullopt;
  }
  if (const double* alpha = arguments[1].number()) c->a = *alpha;
  for (const double component : {c->r, c->g, c->b, c->a}) {
    if (!(component >= 0 && component <= 1)) {
      environment.warn(arguments.at(0),
                       "a colour's components lie between 0 and 1; this one has " + format_number(component));
    }
  }
  return c;
}

std::optional<Solid> color(ModuleCall& call) {
  const std::optional<Rgba> c = color_of(call);
  const Solids parts = children_of(call);
  SceneBuilder& builder = call.evaluator.builder();
  return c ? builder.wrap(ColorAttribute{*c}, parts) : builder.unite(parts);
}

enum MaterialParameter : std::size_t { name, model, kd, ks, kt, ka, shininess, ior, color_, priority };
constexpr std::string_view material_names[] = {"name", "model",     "kd",  "ks",    "kt",
                                               "ka",   "shininess", "ior", "color", "priority"};

MaterialModel require_model(const ModuleArguments& arguments) {
  const String* text = arguments[model].string();
  if (text && text->text() == "whitted") return MaterialModel::whitted;
  if (text && text->text() == "phong") return MaterialModel::phong;
  fail(arguments.at(model), "'model' must be \"whitted\" or \"phong\"");
}

void set_number(const ModuleArguments& arguments, MaterialParameter parameter, double least, double& field) {
  if (!arguments.given(parameter)) return;
  field = require_number(arguments, parameter, material_names[parameter]);
  if (field < least) {
    fail(arguments.at(parameter),
         "'" + std::string(material_names[parameter]) + "' must be at least " + format_number(least));
  }
}

Material material_of(ModuleCall& call) {
  const ModuleArguments arguments(call, material_names, UnknownArgument::fail);
  std::string called;
  if (arguments.given(name)) {
    const String* text = arguments[name].string();
    if (!text) fail(arguments.at(name), "'name' must be a string");
    called = text->text();
  }
  Material m = material_preset(called);
  m.name = called;
  if (arguments.given(model)) m.model = require_model(arguments);
  set_number(arguments, kd, 0, m.kd);
  set_number(arguments, ks, 0, m.ks);
  set_number(arguments, kt, 0, m.kt);
  set_number(arguments, shininess, 0, m.shininess);
  set_number(arguments, priority, -HUGE_VAL, m.priority);
  if (arguments.given(ka)) set_number(arguments, ka, 0, m.ka.emplace());
  if (arguments.given(ior)) {
    set_number(arguments, ior, 0, m.ior);
    if (m.ior == 0) fail(arguments.at(ior), "'ior' must be greater than 0; it is 1 for air and 1.5 for glass");
  }
  if (arguments.given(color_)) {
    m.color = to_color(arguments[color_]);
    if (!m.color) fail(arguments.at(color_), "'color' must be a CSS name, \"#rrggbb\" or [r, g, b]");
  }
  return m;
}

void check_energy(ModuleCall& call, const Material& m) {
  const double sum = m.kd + m.ks + m.kt;
  // Three decimal fractions that add up to 1 miss it by the rounding of each, of its derivation from the others, and of
  // the additions.
  if (std::fabs(sum - 1) <= gamma(8)) return;
  call.evaluator.environment().warn(
      call.at(), "kd + ks + kt is " + format_number(sum) + "; it should be 1, or light is lost or made from nothing");
}

MaterialId intern_material(ModuleCall& call) {
  const Material m = material_of(call);
  check_energy(call, m);
  return call.evaluator.builder().intern(m);
}

std::optional<Solid> material(ModuleCall& call) {
  const MaterialId id = intern_material(call);
  return call.evaluator.builder().wrap(MaterialAttribute{id}, children_of(call));
}

}  // namespace

void add_attribute_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("color"), color);
  table.emplace(symbols.intern("material"), material);
}

}  // namespace tenon::lang
