#pragma once

#include "math/vec2.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// The sign of (a - d)·((b - d) × (c - d)), found exactly (Shewchuk 1997: an expansion where double cannot tell): 1
/// where a, b, c turn clockwise as seen from d, -1 where they turn counterclockwise, 0 where all four lie in one plane.
///
/// Coordinates are neither so large nor so small that products of three overflow or underflow.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The sign of (b - a) × (c - a): 1 where a, b, c turn counterclockwise, 0 where they lie on one line.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace tenon
