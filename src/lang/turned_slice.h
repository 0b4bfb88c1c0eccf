#pragma once

#include <optional>

#include "lang/convex_parts.h"
#include "plane/shape.h"

namespace tenon::lang {

/// Where a solid of revolution meets the plane z = 0 of the world: rings, where its axis is across the plane, and its
/// profile, where it lies in it. Nothing for other primitives, and for other axes.
std::optional<Shape> slice_of_turned(const UnionLeaf& leaf);

}  // namespace tenon::lang
