#pragma once

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// Where a solid meets the plane z = 0, as a flat shape; what has a face there counts above the plane alone. Exact, by
/// the operations of the scene, where that of each primitive is known (leaf_slice.h); else the solid is asked
/// (plane/contour.h).
Solid cut_projection(ModuleEvaluator& evaluator, const Solid& solid, Place at);

/// The shadow of a solid on the plane z = 0. Exact for unions of spheres, cylinders and cones, extrusions along z,
/// and what operations make of polyhedra; else rays along z ask the solid.
Solid shadow_projection(ModuleEvaluator& evaluator, const Solid& solid, Place at);

}  // namespace tenon::lang
