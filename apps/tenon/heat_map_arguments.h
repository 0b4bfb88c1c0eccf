#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "picture_arguments.h"
#include "scene_arguments.h"
#include "tenon/base/error.h"
#include "tenon/image/picture.h"
#include "tenon/render/cost_map.h"

namespace tenon {

/// Whether `tenon render` is to show what each pixel costs in place of its colour, as text.
struct HeatMapArguments {
  std::string cost;  ///< empty: a picture is wanted
  std::string scale = "auto";
  double largest = 0;

  void add_to(CLI::App& command);
  bool wanted() const { return !cost.empty(); }
};

/// How often each pixel is taken (measure_cost): seconds are the only cost that comes out another way next time.
int heat_map_takes(const HeatMapArguments& arguments);

/// The bytes of the file of a heat map: a PNG with a legend, or an EXR with the values themselves in a channel Y.
/// @param accelerator  for the legend
Result<std::string> encode(const CostMap& map, const HeatMapArguments& arguments, const PicturePlan& plan,
                           const std::string& accelerator, const RenderOptions& options,
                           std::vector<PictureNote> notes);

}  // namespace tenon
