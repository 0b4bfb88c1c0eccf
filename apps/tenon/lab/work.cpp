#include <algorithm>

#include "lab/experiments.h"
#include "lab/race.h"
#include "tenon/image/heat_map.h"
#include "tenon/image/picture_file.h"
#include "tenon/render/cost_map.h"

namespace tenon {

namespace {

constexpr int width = 320, height = 240;

/// What a structure did for the picture.
struct MappedWork {
  std::string name;
  CostMap map;
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

// One scale for all: the largest value of them, of which one that stands out alone must not make all others dark.
double common_scale(const std::vector<MappedWork>& all) {
  std::vector<double> most;
  for (const MappedWork& m : all) most.push_back(largest(m.map.primitive_tests));
  return median(most);
}

}  // namespace

Status run_work_heat_maps(Lab& lab, const Paper&, LabTable& table) {
  table.title = "The grooved sphere by every structure";
  table.about =
      "320 x 240 at full effort, one sample a pixel, two lights. The pictures show primitive tests a pixel; their last "
      "colour stands for the median of the structures' largest numbers, and for all above it.";
  table.columns = {{"tests a pixel", FigureForm::number}, {"most tests", FigureForm::count},
                   {"cells a pixel", FigureForm::number}, {"most cells", FigureForm::count},
                   {"time a pixel", FigureForm::seconds}, {"longest pixel", FigureForm::seconds}};
  const Result<LabScene> scene = lab.read("scenes/bench/grooved_sphere.scad", lab.side(width), lab.side(height));
  if (!scene) return scene.error();
  RenderOptions options;
  options.width = lab.side(width);
  options.height = lab.side(height);
  options.threads = 1;
  std::vector<MappedWork> all;
  lab.expect_steps(static_cast<int>(accelerator_names().size()));
  for (const std::string_view name : accelerator_names()) {
    const auto accelerator = build_accelerator(name, *scene->scene.tree, &scene->camera.view());
    if (!accelerator) return accelerator.error();
    constexpr int takes = 3;
    Result<CostMap> map = measure_cost(scene->scene, **accelerator, options, takes);
    if (!map) return map.error();
    all.push_back({std::string(name), std::move(*map)});
    lab.step();
  }
  const double scale = common_scale(all);
  for (const MappedWork& m : all) {
    table.rows.push_back({m.name,
                          {counted(mean(m.map.primitive_tests)), counted(largest(m.map.primitive_tests)),
                           counted(mean(m.map.cells_visited)), counted(largest(m.map.cells_visited)),
                           counted(mean(m.map.seconds)), counted(largest(m.map.seconds))}});
    const HeatMapPicture drawn = draw_heat_map({m.map.window.width(), m.map.window.height(), m.map.primitive_tests,
                                                m.name + ": primitive tests a pixel", HeatScale::linear, scale});
    Result<std::string> png = encode_png({drawn.width, drawn.height, drawn.rgb, {}}, 8, {});
    if (!png) return png.error();
    table.pictures.push_back({"heat_" + m.name, m.name, std::move(*png)});
  }
  return success();
}

}  // namespace tenon
