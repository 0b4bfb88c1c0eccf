#pragma once

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// The convex hull of solids: exact for polyhedra, for spheres and points, and for extrusions along one axis between
/// the same planes; else a polyhedron whose corners lie on the solids (convex_parts.h). Fails where operations other
/// than unions make a solid.
Solid hull_of_solids(ModuleEvaluator& evaluator, const Solid& solid, Place at);

}  // namespace tenon::lang
