#include <cmath>

#include "lang/facets.h"
#include "lang/failure.h"
#include "lang/flat_outline.h"
#include "lang/format.h"
#include "lang/primitive_arguments.h"
#include "text/typeset.h"

namespace tenon::lang {

namespace {

// The text given for a parameter; the fallback, with a warning, where it is none.
std::string text_argument(ModuleCall& call, const ModuleArguments& arguments, std::size_t index, std::string_view name,
                          const std::string& fallback = {}) {
  if (!arguments.given(index)) return fallback;
  if (const String* text = arguments[index].string()) return text->text();
  Environment& environment = call.evaluator.environment();
  environment.warn(arguments.at(index), "'" + std::string(name) + "' must be a text in quotes, not " +
                                            format_value(arguments[index], environment.symbols) +
                                            "; str() makes one of anything");
  return fallback;
}

// Which of some words is given; the first, with a warning, where it is another one.
template <class Choice, std::size_t n>
Choice choice_argument(ModuleCall& call, const ModuleArguments& arguments, std::size_t index, std::string_view name,
                       const std::pair<const char*, Choice> (&choices)[n]) {
  const std::string word = text_argument(call, arguments, index, name, choices[0].first);
  std::string words;
  for (const auto& [choice, value] : choices) {
    if (word == choice) return value;
    words += (words.empty() ? "\"" : ", \"") + std::string(choice) + '"';
  }
  call.evaluator.environment().warn(
      arguments.at(index), "'" + std::string(name) + "' is one of " + words + "; it is \"" + choices[0].first + '"');
  return choices[0].second;
}

FontFile require_font(ModuleCall& call, const ModuleArguments& arguments) {
  const Result<FontFile> font = find_font(text_argument(call, arguments, 2, "font", "Liberation Sans"));
  if (!font) fail(arguments.at(2), font.error().message, font.error().kind);
  if (!font->is_asked_for) {
    call.evaluator.environment().warn(
        arguments.at(2), "the font is not installed; " + font->family + " " + font->style + " stands in for it");
  }
  return *font;
}

// As OpenSCAD cuts a curve of a glyph, where facets are wanted at all.
int segments_of_curve(ModuleCall& call, double size) {
  const int facets = facet_count(call.evaluator, size);
  return facets == 0 ? 0 : std::max(facets / 8 + 1, 2);
}

std::optional<Solid> text(ModuleCall& call) {
  constexpr std::string_view names[] = {"text",    "size",      "font",     "halign", "valign",
                                        "spacing", "direction", "language", "script"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const std::string line = text_argument(call, arguments, 0, "text");
  TextStyle style;
  style.size = number_argument(call, arguments, 1, "size").value_or(style.size);
  style.horizontal = choice_argument<HorizontalAlignment>(call, arguments, 3, "halign",
                                                          {{"left", HorizontalAlignment::left},
                                                           {"center", HorizontalAlignment::center},
                                                           {"right", HorizontalAlignment::right}});
  style.vertical = choice_argument<VerticalAlignment>(call, arguments, 4, "valign",
                                                      {{"baseline", VerticalAlignment::baseline},
                                                       {"top", VerticalAlignment::top},
                                                       {"center", VerticalAlignment::center},
                                                       {"bottom", VerticalAlignment::bottom}});
  style.spacing = number_argument(call, arguments, 5, "spacing").value_or(style.spacing);
  style.direction = text_argument(call, arguments, 6, "direction");
  style.language = text_argument(call, arguments, 7, "language");
  style.script = text_argument(call, arguments, 8, "script");
  if (!std::isfinite(style.size * style.spacing)) fail(call.at(), "'size' and 'spacing' of text() must be finite");
  style.segments = segments_of_curve(call, style.size);
  if (line.empty() || style.size == 0) return Solid::nothing();

  const Result<TypesetText> set = typeset(line, require_font(call, arguments), style);
  if (!set) fail(arguments.at(2), set.error().message, set.error().kind);
  SceneBuilder& builder = call.evaluator.builder();
  Solids glyphs, line_of_glyphs;
  for (const Outline& glyph : set->glyphs) glyphs.push_back(flat_solid(call.evaluator, glyph, call.at()));
  for (const TypesetText::Place& place : set->places) {
    line_of_glyphs.push_back(
        builder.wrap(Transform{Affine3::translate({place.at.x, place.at.y, 0})}, {glyphs[place.glyph]}));
  }
  return builder.unite(line_of_glyphs);
}

}  // namespace

void add_text_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("text"), text);
}

}  // namespace tenon::lang
