#include "picture_notes.h"

#include "numbers.h"
#include "tenon/version.h"

namespace tenon {

namespace {

std::string vector_text(const Vec3& v) {
  return shortest(v.x) + ',' + shortest(v.y) + ',' + shortest(v.z);
}

std::string camera_text(const Camera& camera) {
  const std::string place =
      "from " + vector_text(camera.from) + " at " + vector_text(camera.at) + " up " + vector_text(camera.up);
  return camera.projection == Projection::orthographic ? place + " orthographic width " + shortest(camera.width)
                                                       : place + " fov " + shortest(camera.fov);
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
