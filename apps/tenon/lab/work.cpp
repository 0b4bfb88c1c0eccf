#include <algorithm>

#include "cost_kind.h"
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

// What all but one of a hundred values stay below: those that stand out alone must not make all others dark.
double nearly_largest(std::vector<double> values) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// One scale for all structures.
double common_scale(const std::vector<MappedWork>& all, const CostKind& kind) {
  std::vector<double> most;
  for (const MappedWork& m : all) most.push_back(nearly_largest(kind.values(m.map)));
  return median(most);
}

Result<LabPicture> draw(const MappedWork& work, const CostKind& kind, double scale) {
  const std::vector<double> values = kind.values(work.map);
  const HeatMapPicture drawn = draw_heat_map({work.map.window.width(), work.map.window.height(), values,
                                              work.name + ": " + std::string(kind.legend), HeatScale::linear, scale});
  Result<std::string> png = encode_png({drawn.width, drawn.height, drawn.rgb, {}}, 8, {});
  if (!png) return png.error();
  const std::string name(kind.name);
  return LabPicture{"heat_" + work.name + "_" + name, work.name + ", " + name, std::move(*png)};
}

}  // namespace

Status run_work_heat_maps(Lab& lab, const Paper&, LabTable& table) {
  constexpr int takes = 3;
  table.title = "The grooved sphere by every structure";
  table.about = lab.pixels(width, height) + ", one sample a pixel, two lights; the time of a pixel is the least of " +
                std::to_string(takes) +
                " takes. Each column of pictures has one scale: its last colour stands for the median of what all but "
                "one of a hundred pixels stay below with a structure, and for all above it.";
  table.columns = {{"tests a pixel", FigureForm::number}, {"most tests", FigureForm::count},
                   {"cells a pixel", FigureForm::number}, {"most cells", FigureForm::count},
                   {"time a pixel", FigureForm::seconds}, {"longest pixel", FigureForm::seconds}};
  const Result<LabScene> scene = lab.read("scenes/bench/grooved_sphere.scad", width, height);
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
    Result<CostMap> map = measure_cost(scene->scene, **accelerator, options, takes);
    if (!map) return map.error();
    all.push_back({std::string(name), std::move(*map)});
    lab.step();
  }
  for (const MappedWork& m : all) {
    LabRow row{m.name, {}};
    for (const CostKind& kind : cost_kinds) {
      const std::vector<double>& values = m.map.*kind.costs;
      row.figures.push_back(counted(mean(values)));
      row.figures.push_back(counted(largest(values)));
      Result<LabPicture> picture = draw(m, kind, common_scale(all, kind));
      if (!picture) return picture.error();
      table.pictures.push_back(std::move(*picture));
    }
    table.rows.push_back(std::move(row));
  }
  return success();
}

}  // namespace tenon
