#include "tenon/render/camera_rays.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "render/primary_directions.h"
#include "scene/camera_frame.h"

namespace tenon {

namespace {

Error camera_error(std::string message) {
  return {ErrorKind::input, "camera: " + std::move(message), {}};
}

// The unit square onto the unit disc, evenly, squares onto rings (Shirley and Chiu, "A Low Distortion Map Between Disk
// and Square", 1997).
std::pair<double, double> concentric_disk(double u, double v) {
  const double a = 2 * u - 1, b = 2 * v - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::fabs(a) > std::fabs(b);
  const double r = wide ? a : b;
  const double angle = wide ? b / a * (std::numbers::pi / 4) : std::numbers::pi / 2 - a / b * (std::numbers::pi / 4);
  return {r * std::cos(angle), r * std::sin(angle)};
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
  const double focus = camera.focus.value_or(length(view));
  if (!(camera.aperture >= 0) || !std::isfinite(camera.aperture)) {
    return camera_error("the aperture is the diameter of the lens, and must not be negative");
  }
  if (camera.aperture > 0 && screen.orthographic) {
    return camera_error("parallel rays pass no lens; leave the aperture out, or the orthographic view");
  }
  if (camera.aperture > 0 && !(focus > 0 && std::isfinite(focus))) {
    return camera_error("the focus must lie in front of it");
  }
  return CameraRays(screen, camera.aperture / 2, focus);
}

Ray CameraRays::ray(double x, double y) const {
  if (view_.orthographic) return {view_.eye + screen_offset(view_, x, y), view_.forward};
  return {view_.eye, primary_direction(view_, x, y)};
}

Ray CameraRays::ray(double x, double y, double u, double v) const {
  const Ray through_center = ray(x, y);
  if (!has_lens()) return through_center;
  const auto [s, t] = concentric_disk(u, v);
  const Vec3 start = view_.eye + (lens_radius_ * s) * view_.right + (lens_radius_ * t) * view_.up;
  const Vec3 sharp = view_.eye + (focus_ / dot(through_center.direction, view_.forward)) * through_center.direction;
  return {start, normalize(sharp - start)};
}

}  // namespace tenon
