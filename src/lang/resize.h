#pragma once

#include <array>

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// The scaling about the origin that gives a solid a new size. A new size of 0 leaves a direction as it is, or, where
/// `automatic`, scales it as the direction of the largest new size.
Affine3 resizing(ModuleEvaluator& evaluator, const Solid& solid, const Vec3& new_size,
                 const std::array<bool, 3>& automatic, Place at);

}  // namespace tenon::lang
