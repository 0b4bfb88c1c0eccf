#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "section_arguments.h"
#include "tenon/accel/accelerator.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/error.h"
#include "tenon/render/progress.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// The arguments every command has: which scene, and how to read it.
struct SceneArguments {
  std::string path;
  std::vector<std::string> definitions;
  std::string facets = "auto";
  SectionArguments section;
  std::string cut_faces = "tool";
  bool quiet = false;

  void add_to(CLI::App& command);
  /// The scene's name without folders and suffix; empty for standard input.
  std::string stem() const;
};

/// `--accel` and `--threads`.
struct TracingArguments {
  std::string accelerator{default_accelerator};
  std::string threads = "auto";

  void add_to(CLI::App& command);
  /// Usage errors that are known before the scene is read.
  Status check() const;
  /// The number of threads; only after check().
  int thread_count() const;
};

/// A usage error when no structure has this name; options are not looked at.
Status check_accelerator(const std::string& spec);

/// The structures there are, a line each, for the end of a help text.
std::string accelerator_help();

/// Shows progress, warnings and the scene's own lines on standard error.
class Console {
 public:
  explicit Console(bool quiet)
      : progress_(stderr, progress_style(stderr, quiet)),
        diagnostics_([this](const std::string& line) { progress_.say(line); }) {}

  ProgressDisplay& progress() { return progress_; }
  Diagnostics& diagnostics() { return diagnostics_; }

 private:
  ProgressDisplay progress_;
  Diagnostics diagnostics_;
};

/// Reads and evaluates the scene file, and adds the cuts of the command line to its own.
Result<Model> load(const SceneArguments& arguments, Console& console);

/// What tells a scene from others once it is evaluated, and the pictures of its lights are read.
Result<std::string> scene_fingerprint(const SceneArguments& arguments, Console& console);

/// A scene and the structure over it.
struct TraceableScene {
  Scene scene;
  std::unique_ptr<Accelerator> accelerator;
  double build_seconds = 0;
  std::string fingerprint;  ///< as scene_fingerprint() says; only where there is a picture
};

/// The picture a scene is prepared for.
struct PictureRequest {
  ViewRequest view;
  int width = 0, height = 0;  ///< pixels
};

/// A structure and how long it took.
struct BuiltAccelerator {
  std::unique_ptr<Accelerator> accelerator;
  double seconds = 0;
};
Result<BuiltAccelerator> build_timed(const std::string& spec, const Scene& scene, const ScreenView* view,
                                     Console& console);

/// Reads the scene and builds the structure.
/// @param picture  none: rays may come from anywhere
Result<TraceableScene> prepare(const SceneArguments& arguments, const TracingArguments& tracing, Console& console,
                               const PictureRequest* picture = nullptr);

}  // namespace tenon
