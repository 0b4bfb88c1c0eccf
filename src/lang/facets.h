#pragma once

#include <vector>

#include "lang/module_evaluator.h"
#include "math/vec2.h"

namespace tenon::lang {

/// How many facets a round primitive of radius r gets from $fn, $fa and $fs and the load options; 0 for round.
int facet_count(const ModuleEvaluator& evaluator, double r);

/// The polyhedron that OpenSCAD makes of a cone or a cylinder from z = bottom to bottom + h: corners on the circles,
/// the first at angle 0.
std::vector<Plane> faceted_cone(double h, double r1, double r2, double bottom, int facets);
/// The polyhedron that OpenSCAD makes of a sphere: rings of corners half a step off the poles, from below upwards, by
/// their distance from the axis and their z.
std::vector<Vec2> sphere_profile(double r, int facets);
std::vector<Plane> faceted_sphere(double r, int facets);

}  // namespace tenon::lang
