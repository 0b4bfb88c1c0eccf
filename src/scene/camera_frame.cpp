#include "scene/camera_frame.h"

#include <limits>

namespace tenon {

namespace {

// The axis that lies farthest from the view; z before y before x, so that a view from above has y at its top.
Vec3 default_up(const Vec3& forward) {
  const Vec3 a = abs(forward);
  if (a.z <= a.y && a.z <= a.x) return {0, 0, 1};
  return a.y <= a.x ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
}

Vec3 right_of(const Vec3& forward, const Vec3& up) {
  // The cross product of two directions of length 1 is off by less than 4 rounding errors per component, so one that is
  // no longer than 8 of them has no direction of its own.
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const Vec3 right = cross(forward, normalize(up));
  return normalize(length(right) > rounding ? right : cross(forward, default_up(forward)));
}

}  // namespace

CameraFrame CameraFrame::along(const Vec3& view, const Vec3& up_hint) {
  CameraFrame frame;
  frame.forward = normalize(view);
  frame.right = right_of(frame.forward, up_hint);
  frame.up = cross(frame.right, frame.forward);
  return frame;
}

}  // namespace tenon
