#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scene_arguments.h"
#include "tenon/base/error.h"
#include "tenon/render/camera_rays.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// How much of the papers' work a run of the lab does.
struct LabEffort {
  std::string name = "full";
  double scale = 1;           ///< of the pictures' sides
  int rounds = 5;             ///< that contenders take turns in
  double most_spheres = 1e6;  ///< of the scaling curves
  double curve_seconds = 20;  ///< CPU seconds that one point of a scaling curve may take
};

/// A scene of the lab, ready to be traced.
struct LabScene {
  Scene scene;
  CameraRays camera;
};

/// Variables of a scene and what they are set to, as `tenon -D`.
using Definitions = std::vector<std::pair<std::string, std::string>>;

/// A word as a scene's string.
inline std::string quoted(const std::string& word) {
  return '"' + word + '"';
}

/// What experiments are given: the scenes, the effort, and a place to say how far they are.
class Lab {
 public:
  Lab(std::string root, LabEffort effort, Console& console)
      : root_(std::move(root)), effort_(std::move(effort)), console_(console) {}

  const LabEffort& effort() const { return effort_; }
  const std::string& root() const { return root_; }
  Console& console() { return console_; }

  /// A side of a picture that the paper made this large.
  int side(int pixels) const;
  /// Reads a scene file of the repository.
  /// @param path    from the root, such as "scenes/ima1.scad"
  /// @param width   of the picture, as the paper took it; so is the height
  Result<LabScene> read(const std::string& path, int width, int height, const Definitions& definitions = {}) const;
  /// "512 x 512": what such a picture has here.
  std::string pixels(int width, int height) const;
  /// A file that ./dev lab makes beforehand; empty where it is not there.
  std::string made_file(const std::string& name) const;
  /// The number of triangles in an OFF file.
  std::string triangles_of(const std::string& path) const;

  /// The experiments' share of the whole work, for the time left.
  void begin(double weight_of_all);
  /// The next experiment has this share.
  void expect(double weight);
  /// What is left of it is so many equal steps.
  void expect_steps(int steps);
  /// One of them is done.
  void step();

 private:
  std::string root_;
  LabEffort effort_;
  Console& console_;
  double begun_ = 0, weight_ = 0, step_ = 0, done_ = 0;
};

}  // namespace tenon
