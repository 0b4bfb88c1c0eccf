#pragma once

#include "lang/convex_parts.h"

namespace tenon::lang {

/// The Minkowski sum of an extrusion, convex or not, and a ball around the origin, exactly: the extrusion of the offset
/// outline, that of the outline itself reaching a radius farther at both ends, and along the edges of both ends
/// cylinders, parts of tori, and balls in the corners.
Solid rounded_extrusion(ModuleEvaluator& evaluator, const Extrusion& extrusion, double radius, Place at);

}  // namespace tenon::lang
