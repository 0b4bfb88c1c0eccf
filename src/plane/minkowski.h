#pragma once

#include "tenon/base/error.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// Whether an outline is one convex loop that turns to the left.
bool is_convex(const Outline& outline);

/// The Minkowski sum of two outlines: every sum of a point of one and a point of the other. Exact where both are
/// convex, where one is a circle, and where both are made of segments; else arcs become chords, 128 to a turn.
/// @param a, b  as resolve() returns them
/// @return an error (without place) where there are too many edges to try each of one with each of the other
Result<Outline> minkowski_sum(const Outline& a, const Outline& b);

}  // namespace tenon
