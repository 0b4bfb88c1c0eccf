#include "heat_map_arguments.h"

#include <algorithm>

#include "cost_kind.h"
#include "tenon/image/heat_map.h"
#include "tenon/image/picture_file.h"

namespace tenon {

namespace {

const CostKind& kind_of(const HeatMapArguments& arguments) {
  return *std::find_if(cost_kinds.begin(), cost_kinds.end(),
                       [&](const CostKind& kind) { return arguments.cost == kind.name; });
}

}  // namespace

void HeatMapArguments::add_to(CLI::App& command) {
  command
      .add_option(
          "--heatmap", cost,
          "Show what each pixel costs in place of its colour, shadow rays and all: tests (rays intersected with "
          "a primitive), cells (visited), time. PNG: with a legend; EXR: the numbers themselves. Pixels are "
          "taken one by one, for time three times each")
      ->type_name("COST")
      ->check(CLI::IsMember({"tests", "cells", "time"}));
  command.add_option("--heatmap-scale", scale, "Of its colours: linear, log, or auto: log where few pixels cost most")
      ->type_name("SCALE")
      ->capture_default_str()
      ->check(CLI::IsMember({"auto", "linear", "log"}));
  command
      .add_option("--heatmap-max", largest,
                  "What its last colour stands for, so that pictures can be compared; otherwise the largest number")
      ->type_name("N")
      ->check(CLI::Range(1e-9, 1e18).description("over 0"));
}

int heat_map_takes(const HeatMapArguments& arguments) {
  return arguments.cost == "time" ? 3 : 1;
}

Result<std::string> encode(const CostMap& map, const HeatMapArguments& arguments, const PicturePlan& plan,
                           const std::string& accelerator, const RenderOptions& options,
                           std::vector<PictureNote> notes) {
  const CostKind& kind = kind_of(arguments);
  const std::vector<double> values = kind.values(map);
  const std::string legend(kind.legend);
  notes.push_back({"Heatmap", legend + ", " + accelerator});
  if (plan.format == PictureFormat::exr) {
    Picture picture{options.width, options.height, map.window, {}, std::move(notes)};
    picture.channels.push_back({"Y", ChannelType::float32, std::vector<float>(values.begin(), values.end()), {}});
    return encode_exr(picture);
  }
  const HeatScale scale = arguments.scale == "linear" ? HeatScale::linear
                          : arguments.scale == "log"  ? HeatScale::logarithmic
                                                      : HeatScale::automatic;
  const HeatMapPicture drawn = draw_heat_map(
      {map.window.width(), map.window.height(), values, accelerator + ": " + legend, scale, arguments.largest});
  return encode_png({drawn.width, drawn.height, drawn.rgb, {}}, plan.bits, notes);
}

}  // namespace tenon
