#include "lab/lab.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tenon/lang/load.h"

namespace tenon {

namespace {

// Of the whole work, in the unit that progress is counted in.
constexpr double thousandth = 1e-3;

}  // namespace

int Lab::side(int pixels) const {
  return std::max(16, static_cast<int>(std::lround(pixels * effort_.scale)));
}

Result<LabScene> Lab::read(const std::string& path, int width, int height, const Definitions& definitions) const {
  Diagnostics unheard;
  LoadOptions options;
  options.definitions = definitions;
  Result<Model> model = load_model(root_ + "/" + path, options, unheard);
  if (!model) return model.error();
  Result<Scene> scene = compile_scene(std::move(*model), unheard);
  if (!scene) return scene.error();
  Result<CameraRays> camera = CameraRays::create(scene->camera, side(width), side(height));
  if (!camera) return camera.error();
  return LabScene{std::move(*scene), *camera};
}

std::string Lab::pixels(int width, int height) const {
  return std::to_string(side(width)) + " x " + std::to_string(side(height));
}

std::string Lab::made_file(const std::string& name) const {
  std::string path = std::filesystem::absolute(root_ + "/build/lab/" + name).lexically_normal().string();
  return std::filesystem::exists(path) ? path : "";
}

std::string Lab::triangles_of(const std::string& path) const {
  std::ifstream file(path);
  std::string word, vertices, triangles;
  file >> word >> vertices >> triangles;
  return triangles;
}

void Lab::begin(double weight_of_all) {
  console_.progress().begin("measuring");
  console_.progress().counters().total = static_cast<std::uint64_t>(weight_of_all / thousandth);
}

void Lab::expect(double weight) {
  begun_ += weight_;
  done_ = 0;
  weight_ = weight;
  step_ = 0;
}

void Lab::expect_steps(int steps) {
  step_ = (weight_ - done_) / std::max(1, steps);
}

void Lab::step() {
  done_ = std::min(weight_, done_ + step_);
  console_.progress().counters().done = static_cast<std::uint64_t>((begun_ + done_) / thousandth);
}

}  // namespace tenon
