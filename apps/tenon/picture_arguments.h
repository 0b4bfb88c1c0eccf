#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tenon/base/error.h"
#include "tenon/film/layers.h"
#include "tenon/image/picture_file.h"
#include "tenon/image/tone_map.h"

namespace tenon {

/// What a command that writes a picture is told about its file, as text.
struct PictureArguments {
  std::string output;
  std::string format;
  std::string layers;
  std::string tone_curve = "none";
  double exposure = 0;
  int bits = 0;
  bool denoise = false;

  void add_to(CLI::App& command);
  /// --layers, for the commands that may choose them.
  void add_layers_to(CLI::App& command);
  /// --denoise, for the commands that may do without.
  void add_denoise_to(CLI::App& command);
};

/// The same, understood.
struct PicturePlan {
  std::string output;  ///< "-": standard output
  PictureFormat format = PictureFormat::png;
  int bits = 8;
  Layers layers;  ///< of an EXR
  ToneMapping tone;
  bool denoise = false;
};

/// @param default_output  names the picture when nothing else does; empty where there is no name to take
/// @return the plan, or a usage error
Result<PicturePlan> plan_picture(const PictureArguments& arguments, const std::string& default_output);

}  // namespace tenon
