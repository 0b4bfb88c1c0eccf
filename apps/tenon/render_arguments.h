#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tenon/base/error.h"
#include "tenon/image/picture_file.h"
#include "tenon/render/renderer.h"
#include "view_arguments.h"

namespace tenon {

/// What `tenon render` is told beyond the scene, as text.
struct RenderArguments {
  std::string output;
  std::string size = "640x480";
  std::string integrator = "whitted";
  ViewArguments view;
  std::string statistics;
  int samples = 1;
  int depth = 0;
  std::uint64_t seed = 0;
  int bits = 0;

  void add_to(CLI::App& command);
};

/// The same, understood.
struct RenderPlan {
  std::string output;  ///< "-": standard output
  PictureFormat format = PictureFormat::png;
  int bits = 8;
  int width = 0, height = 0;
  IntegratorKind integrator = IntegratorKind::whitted;
  int depth = 8;
  ViewRequest view;
};

/// @param scene_stem  names the picture when nothing else does; empty for a scene without a name
/// @return the plan, or a usage error
Result<RenderPlan> plan_render(const RenderArguments& arguments, const std::string& scene_stem);

}  // namespace tenon
