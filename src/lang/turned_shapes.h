#pragma once

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// A flat shape turned around z, as far as it lies right of the axis (its y becomes z); one that lies left of it turns
/// as its mirror image. Fails where arcs would not stay arcs.
/// @param degrees  from x towards y; 360 for all around
/// @return with facets where the scene's special variables ask for them ($fn and its like), but where the shape has
/// arcs
Solid turned(ModuleEvaluator& evaluator, const Solid& shape, double degrees, Place at);

}  // namespace tenon::lang
