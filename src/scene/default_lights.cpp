#include "scene/default_lights.h"

#include "scene/camera_frame.h"

namespace tenon {

std::vector<Light> default_lights(const Box3& bounds, const Camera& camera) {
  const auto [forward, right, up] = CameraFrame::along(camera.at - camera.from, camera.up);
  const double reach = 2 * length(bounds.size()) + length(camera.from - camera.at);

  Light key;
  key.position = camera.at + reach * normalize(-0.8 * right + 1.3 * up - 1.0 * forward);
  key.color = {1, 0.98, 0.95, 1};
  key.intensity = 0.8;
  Light fill;
  fill.position = camera.at + reach * normalize(1.2 * right + 0.3 * up - 0.9 * forward);
  fill.color = {0.93, 0.96, 1, 1};
  fill.intensity = 0.3;
  // Beside the eye: what is seen in holes and behind cuts is lit too.
  Light head;
  head.position = camera.at + reach * normalize(0.1 * up - 1.0 * forward);
  head.intensity = 0.35;
  return {key, fill, head};
}

}  // namespace tenon
