#pragma once

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// How a flat shape turns and grows on its way from z = 0 to 1 (primitive/twisted_prism.h).
struct Twist {
  double degrees = 0;
  double scale_x = 1, scale_y = 1;
};

/// A flat shape swept so, operation by operation. Ellipses become arcs (plane/mapped_outline.h).
Solid twisted(ModuleEvaluator& evaluator, const Solid& shape, const Twist& twist, Place at);

}  // namespace tenon::lang
