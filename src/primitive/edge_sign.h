#pragma once

#include "tenon/math/vec3.h"

namespace tenon {

/// On which side of the line origin + t direction the directed edge a→b passes: the sign of
/// direction·((a - origin) × (b - origin)), found exactly (Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
/// Fast Robust Geometric Predicates", 1997: an expansion where double cannot tell).
///
/// Where the line meets the edge, the sign is that for the line moved by an infinitesimal step along one axis and by an
/// infinitesimally smaller one along another (Edelsbrunner & Mücke, "Simulation of Simplicity", 1990). The step depends
/// on the direction alone, so that all edges are judged for one and the same line, and none of them is met by it.
///
/// @param direction  no component so large or so small that products of three overflow or underflow
/// @return 1 or -1; 0 for an edge of length zero or parallel to the line: no triangle that has it can be crossed
int edge_sign(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b);

}  // namespace tenon
