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

enum MaterialParameter : std::size_t {
  name,
  model,
  kd,
  ks,
  kt,
  ka,
  shininess,
  ior,
  color_,
  priority,
  roughness,
  metallic,
  transmission,
  coat,
  coat_roughness,
  emission,
  attenuation_color,
  attenuation_distance,
  texture,
  texture_color,
  texture_size,
  turbulence
};
constexpr std::string_view material_names[] = {"name",
                                               "model",
                                               "kd",
                                               "ks",
                                               "kt",
                                               "ka",
                                               "shininess",
                                               "ior",
                                               "color",
                                               "priority",
                                               "roughness",
                                               "metallic",
                                               "transmission",
                                               "coat",
                                               "coat_roughness",
                                               "emission",
                                               "attenuation_color",
                                               "attenuation_distance",
                                               "texture",
                                               "texture_color",
                                               "texture_size",
                                               "turbulence"};

constexpr std::pair<std::string_view, MaterialModel> material_models[] = {
    {"whitted", MaterialModel::whitted},       {"phong", MaterialModel::phong},
    {"lambert", MaterialModel::lambert},       {"conductor", MaterialModel::conductor},
    {"dielectric", MaterialModel::dielectric}, {"principled", MaterialModel::principled}};

constexpr std::pair<std::string_view, TextureKind> texture_kinds[] = {{"checker", TextureKind::checker},
                                                                      {"marble", TextureKind::marble},
                                                                      {"wood", TextureKind::wood},
                                                                      {"noise", TextureKind::noise}};

// One of a list of words.
template <class Entries>
auto require_word(const ModuleArguments& arguments, MaterialParameter parameter, const Entries& entries) {
  const String* text = arguments[parameter].string();
  std::string all;
  for (const auto& [word, meaning] : entries) {
    if (text && text->text() == word) return meaning;
    all += (all.empty() ? "\"" : ", \"") + std::string(word) + '"';
  }
  fail(arguments.at(parameter), "'" + std::string(material_names[parameter]) + "' must be one of " + all);
}

void set_number(const ModuleArguments& arguments, MaterialParameter parameter, double least, double& field,
                double most = HUGE_VAL) {
  if (!arguments.given(parameter)) return;
  field = require_number(arguments, parameter, material_names[parameter]);
  const std::string called = "'" + std::string(material_names[parameter]) + "' must ";
  if (field < least) fail(arguments.at(parameter), called + "be at least " + format_number(least));
  if (field > most) {
    fail(arguments.at(parameter), called + "lie between " + format_number(least) + " and " + format_number(most));
  }
}

Rgba require_color(const ModuleArguments& arguments, MaterialParameter parameter) {
  const std::optional<Rgba> c = to_color(arguments[parameter]);
  if (c) return *c;
  fail(arguments.at(parameter),
       "'" + std::string(material_names[parameter]) + "' must be a CSS name, \"#rrggbb\" or [r, g, b]");
}

// What a parameter says that only some models have; others refuse it.
void check_model_parameters(const ModuleArguments& arguments, const Material& m) {
  const bool course = m.model == MaterialModel::whitted || m.model == MaterialModel::phong;
  const bool lambert = m.model == MaterialModel::lambert, principled = m.model == MaterialModel::principled;
  const std::pair<MaterialParameter, bool> has[] = {{kd, course},
                                                    {ks, course},
                                                    {kt, course},
                                                    {ka, course},
                                                    {shininess, course},
                                                    {metallic, principled},
                                                    {transmission, principled},
                                                    {coat, principled},
                                                    {coat_roughness, principled},
                                                    {roughness, !course && !lambert},
                                                    {ior, !lambert && m.model != MaterialModel::conductor}};
  for (const auto& [parameter, is_known] : has) {
    if (!arguments.given(parameter) || is_known) continue;
    const std::string_view called = material_models[static_cast<std::size_t>(m.model)].first;
    fail(arguments.at(parameter),
         "a material of model \"" + std::string(called) + "\" has no '" + std::string(material_names[parameter]) + "'");
  }
}

void set_texture(ModuleCall& call, const ModuleArguments& arguments, Material& m) {
  for (const MaterialParameter parameter : {texture_color, texture_size, turbulence}) {
    if (arguments.given(parameter) && !arguments.given(texture)) {
      fail(arguments.at(parameter), "'" + std::string(material_names[parameter]) + "' needs a 'texture'");
    }
  }
  if (!arguments.given(texture)) return;
  m.texture.kind = require_word(arguments, texture, texture_kinds);
  if (arguments.given(texture_color)) m.texture.second = require_color(arguments, texture_color);
  set_number(arguments, texture_size, 0, m.texture.size);
  if (m.texture.size == 0) fail(arguments.at(texture_size), "'texture_size' must be greater than 0");
  set_number(arguments, turbulence, 0, m.texture.turbulence);
  const auto inverse = call.evaluator.world_from_here.inverse();
  if (!inverse) fail(call.at(), "the transformation around it makes the texture flat; scale it otherwise");
  m.texture.texture_from_world = *inverse;
}

void set_attenuation(const ModuleArguments& arguments, Material& m) {
  if (arguments.given(attenuation_color) != arguments.given(attenuation_distance)) {
    const MaterialParameter given = arguments.given(attenuation_color) ? attenuation_color : attenuation_distance;
    fail(arguments.at(given), "'attenuation_color' is what light keeps over 'attenuation_distance'; give both");
  }
  if (!arguments.given(attenuation_color)) return;
  m.attenuation_color = require_color(arguments, attenuation_color);
  for (const double band : {m.attenuation_color.r, m.attenuation_color.g, m.attenuation_color.b}) {
    if (!(band >= 0 && band <= 1)) {
      fail(arguments.at(attenuation_color), "a colour that light keeps has components between 0 and 1");
    }
  }
  set_number(arguments, attenuation_distance, 0, m.attenuation_distance);
  if (m.attenuation_distance == 0)
    fail(arguments.at(attenuation_distance), "'attenuation_distance' must be greater than 0");
  if (!m.is_transparent()) {
    fail(arguments.at(attenuation_color),
         "light is attenuated inside of transparent materials alone; this one is opaque");
  }
}

// A preset is of the course's model; what it says of others is its colour and its index.
void set_model(const ModuleArguments& arguments, Material& m) {
  if (!arguments.given(model)) return;
  m.model = require_word(arguments, model, material_models);
  const bool has_index = m.model == MaterialModel::dielectric || m.model == MaterialModel::principled;
  if (has_index && m.ior == 1) m.ior = 1.5;
  if (m.model == MaterialModel::principled) m.roughness = 0.5;
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
  set_model(arguments, m);
  check_model_parameters(arguments, m);
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
  if (arguments.given(color_)) m.color = require_color(arguments, color_);
  for (const auto& [parameter, field] :
       std::initializer_list<std::pair<MaterialParameter, double*>>{{roughness, &m.roughness},
                                                                    {metallic, &m.metallic},
                                                                    {transmission, &m.transmission},
                                                                    {coat, &m.coat},
                                                                    {coat_roughness, &m.coat_roughness}}) {
    set_number(arguments, parameter, 0, *field, 1);
  }
  set_number(arguments, emission, 0, m.emission);
  set_attenuation(arguments, m);
  set_texture(call, arguments, m);
  return m;
}

void check_energy(ModuleCall& call, const Material& m) {
  if (m.model != MaterialModel::whitted && m.model != MaterialModel::phong) return;
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

constexpr std::string_view cut_faces_names[] = {"show"};

std::optional<Solid> cut_faces(ModuleCall& call) {
  const ModuleArguments arguments(call, cut_faces_names, UnknownArgument::fail);
  const String* text = arguments[0].string();
  const std::string show = text ? text->text() : "";
  if (show != "tool" && show != "base") {
    fail(arguments.at(0), "'show' must be \"tool\" or \"base\": whose material the faces of a cut show");
  }
  const CutFacesAttribute attribute{show == "base" ? CutFaces::base : CutFaces::tool};
  return call.evaluator.builder().wrap(attribute, children_of(call));
}

}  // namespace

void add_attribute_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("color"), color);
  table.emplace(symbols.intern("material"), material);
  table.emplace(symbols.intern("cut_faces"), cut_faces);
}

}  // namespace tenon::lang
