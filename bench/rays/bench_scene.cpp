#include "rays/bench_scene.h"

#include <filesystem>

#include "tenon/lang/load.h"

namespace tenon::bench {

const std::vector<std::string>& scene_names() {
  static const std::vector<std::string> names{"grooved_sphere", "checkered_cube", "small_shell",
                                              "large_shell",    "swiss_cheese",   "gear_plate"};
  return names;
}

std::string scene_path(const std::string& name) {
  return "scenes/bench/" + name + ".scad";
}

Result<BenchScene> read_scene(const std::string& path,
                              const std::vector<std::pair<std::string, std::string>>& definitions) {
  Diagnostics unheard;
  LoadOptions options;
  options.definitions = definitions;
  Result<Model> model = load_model(path, options, unheard);
  if (!model) return model.error();
  Result<Scene> scene = compile_scene(std::move(*model), unheard);
  if (!scene) return scene.error();
  Result<CameraRays> camera = CameraRays::create(scene->camera, picture_width, picture_height);
  if (!camera) return camera.error();
  return BenchScene{std::filesystem::path(path).stem().string(), std::move(*scene), std::move(*camera)};
}

}  // namespace tenon::bench
