#pragma once

#include <string>
#include <vector>

#include "tenon/base/error.h"
#include "tenon/render/camera_rays.h"
#include "tenon/scene/scene.h"

namespace tenon::bench {

/// A scene of the bench, ready to be traced, seen at 640 x 480.
struct BenchScene {
  std::string name;
  Scene scene;
  CameraRays camera;
};

inline constexpr int picture_width = 640, picture_height = 480;

/// The six scenes that every contender traces.
const std::vector<std::string>& scene_names();

/// Scenes for Tenon's structures alone: of several media, of a part that is stored once, and of what OpenSCAD's users
/// model.
inline const std::vector<std::string> own_scenes = {"tumblers", "copies", "mount"};

/// Reads a scene file. `definitions` as `tenon -D`.
Result<BenchScene> read_scene(const std::string& path,
                              const std::vector<std::pair<std::string, std::string>>& definitions = {});
/// One of scenes/bench/.
std::string scene_path(const std::string& name);

}  // namespace tenon::bench
