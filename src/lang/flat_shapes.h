#pragma once

#include "lang/module_evaluator.h"

/// Shapes of the plane. A flat shape is a part of the scene graph like any other, swept from z = 0 to 1: a circle is a
/// cylinder, a square a cube, a polygon a prism, each of height 1, and what transforms it leaves z alone. So all
/// operations on shapes are those on solids, exact, and to extrude a shape is to scale it along z.
namespace tenon::lang {

/// What a transformation does to shapes of the plane: as in OpenSCAD, its part in the plane.
Affine3 flattened(const Affine3& map);

/// The union of the children of a call; nothing, with a warning, where they are solids.
Solid flat_children(ModuleCall& call);

/// A flat shape swept from z = 0 to 1 that grows on the way to `scale` times its size.
Solid tapered(ModuleEvaluator& evaluator, const Solid& shape, double scale, Place at);

}  // namespace tenon::lang
