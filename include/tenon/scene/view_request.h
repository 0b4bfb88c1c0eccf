#pragma once

#include <optional>

#include "tenon/scene/camera.h"

namespace tenon {

/// A direction to look from, degrees.
struct ViewAngles {
  double azimuth = 0;    ///< around z: 0 from +x, 90 from +y, -90 from the front
  double elevation = 0;  ///< above the xy-plane: 90 from above
};

/// How a scene is to be looked at, in place of what its file says.
struct ViewRequest {
  std::optional<Camera> camera;      ///< none: the file's; where that has none either, one is chosen
  std::optional<ViewAngles> angles;  ///< look from there, at the whole solid
  bool fit = false;  ///< move the camera, along its direction and across, until the solid takes 95 % of the picture
  std::optional<double> aperture;   ///< of the camera's lens (Camera::aperture)
  std::optional<double> focus;      ///< Camera::focus
  std::optional<Vec3> focus_point;  ///< a point that is sharp, in place of `focus`
  bool keeps_light = false;         ///< what a section view takes away still casts its shadows
  bool orthographic = false;        ///< parallel rays, covering what the camera sees at the point it looks at
  double aspect = 4.0 / 3;          ///< width of the picture over its height
};

}  // namespace tenon
