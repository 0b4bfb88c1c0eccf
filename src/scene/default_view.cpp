#include <cmath>
#include <numbers>

#include "tenon/scene/scene.h"

namespace tenon {

Camera default_camera(const Box3& bounds) {
  Camera camera;
  const Vec3 size = bounds.size();
  // The ball around the bounds, seen under the vertical field of view of a 4:3 picture with a little air around it.
  const double radius = std::max(0.5 * length(size), std::numeric_limits<double>::min());
  const double half_fov = 0.5 * camera.fov * (std::numbers::pi / 180);
  const double distance = radius / std::sin(std::atan(0.75 * std::tan(half_fov)));
  // Flat things are looked at from higher up, towers from lower down.
  const double flatness = size.z / std::max(std::max(size.x, size.y), std::numeric_limits<double>::min());
  const double elevation = (flatness < 0.2 ? 45.0 : flatness > 2 ? 20.0 : 30.0) * (std::numbers::pi / 180);
  const double azimuth = -60 * (std::numbers::pi / 180);
  const Vec3 towards{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                     std::sin(elevation)};
  camera.at = bounds.center();
  camera.from = camera.at + towards * distance;
  return camera;
}

std::vector<Light> default_lights(const Box3& bounds, const Camera& camera) {
  // A frame that stands where the camera does, so that every side of the solid is lit well when it is the one shown.
  const Vec3 back = normalize(camera.from - camera.at);
  Vec3 right = normalize(cross(camera.up, back));
  if (right == Vec3{}) right = {1, 0, 0};
  const Vec3 up = cross(back, right);
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
