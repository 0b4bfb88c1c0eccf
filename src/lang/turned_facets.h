#pragma once

#include <vector>

#include "lang/module_evaluator.h"
#include "tenon/primitive/outline.h"

namespace tenon::lang {

/// The solid that OpenSCAD makes of an outline that is turned around z: flat faces between copies of the outline.
/// @param outline  of segments alone, right of the axis; its y becomes z
/// @param on_axis  corners no further from the axis than this are on it
/// @param angles   of the copies, in degrees, growing by less than 180 from one to the next and from the last to the
///                 first
Solid turned_in_facets(ModuleEvaluator& evaluator, const Outline& outline, double on_axis,
                       const std::vector<double>& angles, Place at);

/// The angles of the copies.
/// @param facets   of the part that is turned through
/// @param degrees  of that part, from 0; all around, from the negative x axis, where it is 360 or more. What is left of
///                 the circle behind a part is closed in any way
std::vector<double> facet_angles(int facets, double degrees);

}  // namespace tenon::lang
