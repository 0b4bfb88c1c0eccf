#pragma once

#include <vector>

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// A ball; of radius 0, a point.
struct Ball {
  Vec3 center;
  double radius = 0;
};

/// The convex hull of balls and points, exact: the balls, a cone along each edge of the hull, and the polyhedron of the
/// points where planes touch the balls from outside. More than 64 that count, where balls are among them, become points
/// 2 degrees apart: every three of them would have to be tried.
/// @param at  of what asks for it
Solid ball_hull(ModuleEvaluator& evaluator, std::vector<Ball> balls, Place at);

}  // namespace tenon::lang
