#pragma once

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// The Minkowski sum of two solids or more, each a union: the union of the sums of their primitives. Exact for
/// polyhedra and spheres, for extrusions along one axis, and for solids of revolution with a sphere; for other convex
/// primitives a polyhedron of points 2 degrees apart on circles. Fails for others.
Solid minkowski_of_solids(ModuleEvaluator& evaluator, const Solids& solids, Place at);

}  // namespace tenon::lang
