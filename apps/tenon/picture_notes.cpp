#include "picture_notes.h"

#include <array>
#include <charconv>

#include "tenon/version.h"

namespace tenon {

namespace {

std::string number_text(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string vector_text(const Vec3& v) {
  return number_text(v.x) + ',' + number_text(v.y) + ',' + number_text(v.z);
}

std::string camera_text(const Camera& camera) {
  const std::string place =
      "from " + vector_text(camera.from) + " at " + vector_text(camera.at) + " up " + vector_text(camera.up);
  return camera.projection == Projection::orthographic ? place + " orthographic width " + number_text(camera.width)
                                                       : place + " fov " + number_text(camera.fov);
}

}  // namespace

std::vector<PictureNote> picture_notes(const PictureOrigin& origin) {
  // In the order that an EXR gives them back in.
  return {{"Camera", camera_text(origin.camera)},
          {"Scene", origin.fingerprint},
          {"Seed", std::to_string(origin.seed)},
          {"Software", "tenon " + std::string(version())},
          {"Source", "tenon render " + origin.scene + origin.arguments},
          {"Title", origin.scene}};
}

}  // namespace tenon
