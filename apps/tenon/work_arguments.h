#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "tenon/base/error.h"
#include "tenon/render/renderer.h"

namespace tenon {

/// How much of a picture, or how many, `tenon render` is to take, for how long, and what is kept on the way; as text.
struct WorkArguments {
  std::uint32_t samples_per_pixel = 0;  ///< 0: not said
  std::string crop;
  std::string samples;
  double noise = 0;
  double seconds = 0;
  std::string checkpoint;
  double checkpoint_seconds = 60;
  int frames = 0;  ///< 0: one picture
  bool resume = false;

  void add_to(CLI::App& command);
};

/// Reads the arguments into the options of a picture whose size is known.
/// @return success, or a usage error
Status plan_work(const WorkArguments& arguments, RenderOptions& options);

}  // namespace tenon
