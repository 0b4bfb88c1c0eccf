#pragma once

#include "tenon/math/vec3.h"

namespace tenon {

/// The view a structure may be built for: RR-612 subdivides along the eye's axes, and filters primary rays by the
/// rectangles that boxes project to on the screen. The answers do not depend on it.
struct ScreenView {
  Vec3 eye;
  Vec3 right, up, forward;  ///< orthonormal
  bool orthographic = false;
  double half_width = 1;      ///< of the screen: at distance 1 (perspective), or in the scene's units (orthographic)
  int width = 0, height = 0;  ///< pixels; they are square
};

}  // namespace tenon
