#pragma once

#include "tenon/math/vec3.h"

namespace tenon {

enum class Projection { perspective, orthographic };

/// Where the picture is taken from.
struct Camera {
  Projection projection = Projection::perspective;
  Vec3 from{10, -10, 10};
  Vec3 at;
  Vec3 up{0, 0, 1};
  double fov = 40;    ///< perspective: horizontal field of view, degrees
  double width = 10;  ///< orthographic: what the picture's width covers, in the scene's units

  friend bool operator==(const Camera&, const Camera&) = default;
};

}  // namespace tenon
