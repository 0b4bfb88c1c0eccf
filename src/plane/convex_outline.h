#pragma once

#include "tenon/primitive/outline.h"

namespace tenon {

/// The convex hull of outlines, exact: what is round on it are arcs of the outlines, and tangents join them.
/// @return a loop that turns to the left; none where all points lie on a line
Outline convex_hull(const Outline& outline);

}  // namespace tenon
