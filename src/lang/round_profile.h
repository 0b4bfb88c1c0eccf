#pragma once

#include <optional>

#include "lang/convex_parts.h"
#include "plane/shape.h"

namespace tenon::lang {

/// The profile of a solid of revolution on both sides of its axis: x across, y along it. Nothing for other primitives.
std::optional<Shape> full_profile(const UnionLeaf& leaf);

/// The profile under a map that keeps the z axis, and circles around it, but for rounding; nothing under others, and
/// where arcs would not stay arcs.
std::optional<Outline> aligned_profile(const UnionLeaf& leaf, const Affine3& map);

/// The solid of revolution of a profile on both sides of the axis, in a frame.
Solid revolved(ModuleEvaluator& evaluator, const Outline& profile, const Affine3& frame, Place at);

}  // namespace tenon::lang
