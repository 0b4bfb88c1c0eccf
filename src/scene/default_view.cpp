#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tenon/math/affine3.h"
#include "tenon/scene/scene.h"

namespace tenon {

namespace {

struct Frame {
  Vec3 back, right, up;
};

// The axes of a camera that looks along -back.
Frame view_frame(const Vec3& towards_camera, const Vec3& up_hint) {
  Frame frame;
  frame.back = normalize(towards_camera);
  frame.right = normalize(cross(up_hint, frame.back));
  if (frame.right == Vec3{}) frame.right = {1, 0, 0};
  frame.up = cross(frame.back, frame.right);
  return frame;
}

}  // namespace

Camera default_camera(const Box3& bounds) {
  Camera camera;
  const Vec3 size = bounds.size();
  constexpr double smallest = std::numeric_limits<double>::min();
  // Flat things are looked at from higher up, towers from lower down.
  const double flatness = size.z / std::max(std::max(size.x, size.y), smallest);
  const double elevation = flatness < 0.2 ? 45.0 : flatness > 2 ? 20.0 : 30.0;
  const Frame frame = view_frame(
      {cos_degrees(elevation) * cos_degrees(-60), cos_degrees(elevation) * sin_degrees(-60), sin_degrees(elevation)},
      camera.up);
  camera.at = bounds.center();

  // As near as every corner of the bounds stays in a 4:3 picture, with a little air around.
  constexpr double air = 0.88;
  const double tan_x = air * std::tan(0.5 * camera.fov * (std::numbers::pi / 180)), tan_y = 0.75 * tan_x;
  double distance = smallest;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner{(i & 1) != 0 ? bounds.upper.x : bounds.lower.x, (i & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                      (i & 4) != 0 ? bounds.upper.z : bounds.lower.z};
    const Vec3 v = corner - camera.at;
    const double nearer = dot(v, frame.back);
    distance = std::max(
        {distance, nearer + std::fabs(dot(v, frame.right)) / tan_x, nearer + std::fabs(dot(v, frame.up)) / tan_y});
  }
  camera.from = camera.at + frame.back * distance;
  return camera;
}

std::vector<Light> default_lights(const Box3& bounds, const Camera& camera) {
  // Lights that stand where the camera does, so that whatever side is shown is lit well.
  const auto [back, right, up] = view_frame(camera.from - camera.at, camera.up);
  const double reach = 2 * length(bounds.size()) + length(camera.from - camera.at);

  Light key;
  key.position = camera.at + reach * normalize(-0.8 * right + 1.3 * up + 1.0 * back);
  key.color = {1, 0.98, 0.95, 1};
  key.intensity = 0.75;
  Light fill;
  fill.position = camera.at + reach * normalize(1.2 * right + 0.3 * up + 0.9 * back);
  fill.color = {0.93, 0.96, 1, 1};
  fill.intensity = 0.35;
  return {key, fill};
}

}  // namespace tenon
