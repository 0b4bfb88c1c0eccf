#include <cmath>

#include "lang/builtin_functions.h"
#include "lang/drawing_file.h"
#include "lang/source_files.h"

namespace tenon::lang {

namespace {

// The arguments of the functions on drawings go by their names alone, as in OpenSCAD.
struct DrawingQuestion {
  DrawingRequest request;
  std::string name;
};

std::optional<DrawingQuestion> question(const BuiltinCall& call) {
  DrawingQuestion asked;
  asked.request.named_at = asked.request.layer_at = call.at;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const std::string name = call.names[i] ? call.environment.text(call.names[i]) : "";
    const Value& value = call.arguments[i];
    const String* text = value.string();
    if (name == "file" && text) {
      asked.request.file = SourceFiles::find(text->text(), call.at);
    } else if (name == "layer" && text) {
      asked.request.layer = text->text();
    } else if (name == "name" && text) {
      asked.name = text->text();
    } else if (name == "scale" && value.number() && std::isfinite(*value.number())) {
      asked.request.scale = *value.number();
    } else if (const auto origin = to_vec3(value, 0); name == "origin" && origin) {
      asked.request.origin = {origin->x, origin->y};
    } else {
      call.refuse("takes file = \"…\", layer = \"…\", name = \"…\", origin = [x, y] and scale = s, by these names");
      return std::nullopt;
    }
  }
  if (asked.request.file.empty()) {
    call.refuse("needs file = \"…\", the name of a drawing");
    return std::nullopt;
  }
  return asked;
}

Value dxf_dim(const BuiltinCall& call) {
  const auto asked = question(call);
  if (!asked) return {};
  const Drawing drawing = require_drawing(call.environment, asked->request);
  const Result<double> value = measure(drawing, asked->request.layer, asked->name);
  return value ? Value(*value) : call.refuse("finds nothing to measure: " + value.error().message);
}

Value dxf_cross(const BuiltinCall& call) {
  const auto asked = question(call);
  if (!asked) return {};
  const Drawing drawing = require_drawing(call.environment, asked->request);
  const Result<Vec2> point = crossing(drawing, asked->request.layer);
  if (!point) return call.refuse("finds no crossing: " + point.error().message);
  return make_list({point->x, point->y}, call.environment.budget);
}

}  // namespace

void add_drawing_functions(BuiltinFunctionTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("dxf_dim"), dxf_dim);
  table.emplace(symbols.intern("dxf_cross"), dxf_cross);
}

}  // namespace tenon::lang
