#pragma once

#include <optional>

#include "lang/convex_parts.h"
#include "plane/shape.h"

namespace tenon::lang {

/// Where what an outline sweeps along the z axis of its primitive meets the plane z = 0 of the world: cylinders, cones
/// and prisms. Exact, with arcs that keep within 2⁻²⁰ of ellipses and other conics.
///
/// Nothing for other primitives, for what twists or is scaled unevenly on its way around an axis that is not across the
/// plane, and where the plane runs along the axis all but exactly.
std::optional<Shape> slice_of_sweep(const UnionLeaf& leaf);

}  // namespace tenon::lang
