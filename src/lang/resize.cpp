#include "lang/resize.h"

namespace tenon::lang {

Affine3 resizing(ModuleEvaluator& evaluator, const Solid& solid, const Vec3& new_size,
                 const std::array<bool, 3>& automatic, Place at) {
  static_cast<void>(evaluator);
  static_cast<void>(solid);
  static_cast<void>(new_size);
  static_cast<void>(automatic);
  fail(at, "resize() is not supported yet; use scale()");
}

}  // namespace tenon::lang
