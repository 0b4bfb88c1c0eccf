#pragma once

#include "drawing/load_drawing.h"
#include "lang/module_arguments.h"

namespace tenon::lang {

/// What is asked of a drawing file.
struct DrawingRequest {
  std::string file;  ///< as it is found
  Place named_at;
  std::string layer;  ///< empty for all
  Place layer_at;
  Vec2 origin;
  double scale = 1;
};

/// The drawing, placed; fails where it cannot be read.
Drawing require_drawing(Environment& environment, const DrawingRequest& request);

/// The flat shape of what its paths enclose.
Solid shape_of_drawing(ModuleEvaluator& evaluator, const DrawingRequest& request);

/// The request that arguments of a module make.
/// @param file, layer, origin  indices of the arguments
DrawingRequest drawing_request(ModuleCall& call, const ModuleArguments& arguments, std::size_t file, std::size_t layer,
                               std::size_t origin);

}  // namespace tenon::lang
