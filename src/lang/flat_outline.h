#pragma once

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// The outline of a leaf of a flat shape: a cylinder, a cube or a prism.
Outline outline_of_leaf(const PrimitiveStore& store, PrimitiveId id);

/// The outline of a flat shape as a whole, with its operations carried out (plane/shape.h). Attributes are left behind.
/// @param at  of what needs it, for messages
Outline outline_of(ModuleEvaluator& evaluator, const Solid& shape, Place at);

/// A flat shape of an outline; nothing where it has no loops.
Solid flat_solid(ModuleEvaluator& evaluator, Outline outline, Place at);

}  // namespace tenon::lang
