#include "tenon/render/camera_rays.h"

#include <cmath>
#include <numbers>

#include "scene/camera_frame.h"

namespace tenon {

namespace {

Error camera_error(std::string message) {
  return {ErrorKind::input, "camera: " + std::move(message), {}};
}

bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

Result<CameraRays> CameraRays::create(const Camera& camera, int width, int height) {
  if (!is_finite(camera.from) || !is_finite(camera.at) || !is_finite(camera.up)) {
    return camera_error("`from`, `at` and `up` must be finite numbers");
  }
  const Vec3 view = camera.at - camera.from;
  if (view == Vec3{} || !is_finite(view)) return camera_error("it stands where it looks at; move `from` or `at`");

  ScreenView screen;
  screen.eye = camera.from;
  const CameraFrame frame = CameraFrame::along(view, camera.up);
  screen.forward = frame.forward;
  screen.right = frame.right;
  screen.up = frame.up;
  screen.width = width;
  screen.height = height;
  screen.orthographic = camera.projection == Projection::orthographic;
  if (screen.orthographic) {
    if (!(camera.width > 0) || !std::isfinite(camera.width)) {
      return camera_error("the width that an orthographic view covers must be positive");
    }
    screen.half_width = camera.width / 2;
  } else {
    if (!(camera.fov > 0 && camera.fov < 180)) {
      return camera_error("the field of view must lie between 0 and 180 degrees");
    }
    screen.half_width = std::tan(camera.fov * (std::numbers::pi / 360));
  }
  return CameraRays(screen);
}

Ray CameraRays::ray(double x, double y) const {
  // 2x - width is exact at pixel centres, so the two halves of the picture are mirror images to the last bit.
  const double scale = view_.half_width / view_.width;
  const Vec3 offset = ((2 * x - view_.width) * scale) * view_.right + ((view_.height - 2 * y) * scale) * view_.up;
  if (view_.orthographic) return {view_.eye + offset, view_.forward};
  return {view_.eye, normalize(view_.forward + offset)};
}

}  // namespace tenon
