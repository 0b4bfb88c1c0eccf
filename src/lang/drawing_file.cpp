#include "lang/drawing_file.h"

#include <algorithm>

#include "lang/failure.h"
#include "lang/flat_outline.h"
#include "lang/source_files.h"

namespace tenon::lang {

namespace {

void warn_of_missing_layer(Environment& environment, const DrawingRequest& request, const Drawing& drawing) {
  if (request.layer.empty()) return;
  if (std::find(drawing.layers.begin(), drawing.layers.end(), request.layer) != drawing.layers.end()) return;
  std::string there_are;
  for (const std::string& layer : drawing.layers) there_are += (there_are.empty() ? "'" : ", '") + layer + "'";
  environment.warn(request.layer_at, "the drawing has nothing on a layer '" + request.layer + "'" +
                                         (there_are.empty() ? "" : "; there is " + there_are));
}

}  // namespace

Drawing require_drawing(Environment& environment, const DrawingRequest& request) {
  Result<Drawing> drawing = load_drawing(request.file);
  if (!drawing) throw Failure{drawing.error()};
  warn_of_missing_layer(environment, request, *drawing);
  place(*drawing, request.origin, request.scale);
  return std::move(*drawing);
}

Solid shape_of_drawing(ModuleEvaluator& evaluator, const DrawingRequest& request) {
  Environment& environment = evaluator.environment();
  const Drawing drawing = require_drawing(environment, request);
  for (const std::string& note : drawing.notes) environment.warn(request.named_at, request.file + ": " + note);
  DrawnOutline drawn = outline_of_layer(drawing, request.layer);
  if (drawn.open_paths > 0) {
    environment.warn(request.named_at,
                     request.file + ": " + std::to_string(drawn.open_paths) +
                         (drawn.open_paths == 1 ? " path is open and is" : " paths are open and are") +
                         " closed by a segment");
  }
  return flat_solid(evaluator, std::move(drawn.outline), request.named_at);
}

DrawingRequest drawing_request(ModuleCall& call, const ModuleArguments& arguments, std::size_t file, std::size_t layer,
                               std::size_t origin) {
  const String* name = arguments[file].string();
  if (!name) fail(arguments.at(file), "'file' must be the name of a drawing in quotes");
  DrawingRequest request{
      SourceFiles::find(name->text(), call.at()), arguments.at(file), {}, arguments.at(layer), {}, 1};
  if (const String* text = arguments[layer].string()) request.layer = text->text();
  if (arguments.given(origin)) {
    const auto point = to_vec3(arguments[origin], 0);
    if (!point) fail(arguments.at(origin), "'origin' must be a list of two finite numbers");
    request.origin = {point->x, point->y};
  }
  return request;
}

}  // namespace tenon::lang
