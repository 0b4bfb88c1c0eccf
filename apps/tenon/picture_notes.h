#pragma once

#include <string>
#include <vector>

#include "tenon/image/picture.h"
#include "tenon/scene/camera.h"

namespace tenon {

/// What a picture says about itself.
struct PictureOrigin {
  std::string scene;        ///< the file's path
  std::string arguments;    ///< that the picture depends on: of a command that takes it again
  std::string fingerprint;  ///< of the scene
  std::uint64_t seed = 0;
  Camera camera;
};

/// The same as text beside the pixels: what the picture depends on, and nothing else. The same picture is the same
/// file, whatever threads, structure and name it was made with, and in how many parts.
std::vector<PictureNote> picture_notes(const PictureOrigin& origin);

}  // namespace tenon
