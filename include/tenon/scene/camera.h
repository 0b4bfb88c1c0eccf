#pragma once

#include <optional>

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
  /// Perspective: the diameter of a thin lens around `from`, in the scene's units; 0: all is sharp. A point at distance
  /// z along the view is blurred, where the picture is sharp, to a disc of diameter aperture |z - focus| / z.
  double aperture = 0;
  std::optional<double> focus;  ///< the distance along the view where all is sharp; none: that of `at`

  friend bool operator==(const Camera&, const Camera&) = default;
};

}  // namespace tenon
