#pragma once

#include <optional>

#include "lang/convex_parts.h"
#include "plane/shape.h"

namespace tenon::lang {

/// Where a primitive meets the plane z = 0; a face that lies there counts above the plane alone. Nothing where that is
/// not known in segments and arcs: of quadrics but spheres, cylinders and cones, of what is turned around an axis that is neither across the
/// plane nor in it, and of what twists around one that is not across it.
std::optional<Shape> slice_of_leaf(const UnionLeaf& leaf);

}  // namespace tenon::lang
