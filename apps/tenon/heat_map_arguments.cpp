#include "heat_map_arguments.h"

#include <algorithm>
#include <array>

#include "tenon/image/heat_map.h"
#include "tenon/image/picture_file.h"

namespace tenon {

namespace {

struct CostName {
  const char* name;
  const char* title;
  std::vector<double> CostMap::*values;
  double scale;
};
constexpr std::array<CostName, 3> costs{{{"tests", "primitive tests a pixel", &CostMap::primitive_tests, 1},
                                         {"cells", "cells visited a pixel", &CostMap::cells_visited, 1},
                                         {"time", "microseconds a pixel", &CostMap::seconds, 1e6}}};

const CostName& cost_of(const HeatMapArguments& arguments) {
  return *std::find_if(costs.begin(), costs.end(), [&](const CostName& c) { return arguments.cost == c.name; });
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
  const CostName& cost = cost_of(arguments);
  std::vector<double> values = map.*(cost.values);
  for (double& v : values) v *= cost.scale;
  notes.push_back({"Heatmap", std::string(cost.title) + ", " + accelerator});
  if (plan.format == PictureFormat::exr) {
    Picture picture{options.width, options.height, map.window, {}, std::move(notes)};
    picture.channels.push_back({"Y", ChannelType::float32, std::vector<float>(values.begin(), values.end()), {}});
    return encode_exr(picture);
  }
  const HeatScale scale = arguments.scale == "linear" ? HeatScale::linear
                          : arguments.scale == "log"  ? HeatScale::logarithmic
                                                      : HeatScale::automatic;
  const HeatMapPicture drawn = draw_heat_map(
      {map.window.width(), map.window.height(), values, accelerator + ": " + cost.title, scale, arguments.largest});
  return encode_png({drawn.width, drawn.height, drawn.rgb, {}}, plan.bits, notes);
}

}  // namespace tenon
