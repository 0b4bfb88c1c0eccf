#pragma once

#include "tenon/accel/screen_view.h"
#include "tenon/base/error.h"
#include "tenon/math/ray.h"
#include "tenon/scene/camera.h"

namespace tenon {

/// The primary rays of a camera for a picture of a given size.
class CameraRays {
 public:
  /// @param camera  any `up` that is parallel to the view (or zero) is replaced by the z axis, or by y for a view along
  /// z
  /// @param width   of the picture, pixels; so is height. Pixels are square: `fov` and `Camera::width` cover the width
  /// @return the rays, or an input error: a camera that looks nowhere, or an impossible angle or width
  static Result<CameraRays> create(const Camera& camera, int width, int height);

  /// The ray through a place of the picture, in pixels from its upper left corner: the centre of the first pixel is
  /// (0.5, 0.5). The direction has length 1, so t is a distance.
  /// Of a lens it is the ray through the centre.
  Ray ray(double x, double y) const;

  /// Whether rays start all over a lens.
  bool has_lens() const { return lens_radius_ > 0; }

  /// The ray through a place of the picture and one of the lens (its centre where there is none), both rays through a
  /// place of the picture meeting where it is sharp.
  /// @param u  with v a place in the unit square, which is spread evenly over the lens
  Ray ray(double x, double y, double u, double v) const;

  /// What a structure may be built for (build_accelerator).
  const ScreenView& view() const { return view_; }

 private:
  CameraRays(const ScreenView& view, double lens_radius, double focus)
      : view_(view), lens_radius_(lens_radius), focus_(focus) {}

  ScreenView view_;
  double lens_radius_;
  double focus_;  // distance along the view
};

}  // namespace tenon
