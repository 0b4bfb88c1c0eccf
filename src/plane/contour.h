#pragma once

#include <functional>

#include "math/vec2.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// The outline of a set of points of the plane that is known by asking for points alone. Its corners lie on the set's
/// boundary, and its segments and arcs within 2⁻¹⁷ of the size of the box; what is thinner than 1/512 of the box may be
/// missed.
/// @param lower, upper  a box that holds the set
Outline contour(const std::function<bool(const Vec2&)>& inside, const Vec2& lower, const Vec2& upper);

}  // namespace tenon
