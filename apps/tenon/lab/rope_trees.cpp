#include <algorithm>
#include <array>
#include <cmath>

#include "lab/experiments.h"
#include "lab/race.h"
#include "lab/ratios.h"

namespace tenon {

namespace {

/// A scene of the paper's table 2.
struct PolygonScene {
  const char* name;
  const char* model;  ///< of lab/scenes/rope_trees.scad
};
constexpr std::array<PolygonScene, 8> scenes{{{"Octagon", "octagon"},
                                              {"Cylinder 100", "cylinder_100"},
                                              {"Cylinder 10000", "cylinder_10000"},
                                              {"Teapot", "teapot"},
                                              {"Banana", "banana"},
                                              {"Eagle", "eagle"},
                                              {"Small random triangles", "small_triangles"},
                                              {"Large random triangles", "large_triangles"}}};
constexpr std::array<const char*, 3> structures{"bsp", "ropes", "rope-trees"};
constexpr int width = 320, height = 240;
constexpr int specular_depth = 5;

/// One scene with the three structures, in their order.
Result<std::vector<RaceResult>> race_polygons(Lab& lab, const PolygonScene& s, bool specular) {
  const Result<LabScene> scene =
      lab.read("lab/scenes/rope_trees.scad", lab.side(width), lab.side(height),
               {{"model", '"' + std::string(s.model) + '"'}, {"specular", specular ? "true" : "false"}});
  if (!scene) return scene.error();
  std::vector<Contender> contenders;
  for (const char* name : structures) contenders.push_back({name, &*scene, std::string(name) + ":depth=20,leaf=4"});
  RenderOptions options;
  options.depth = specular ? specular_depth : 1;
  return race(lab, contenders, options);
}

double seconds_in_all(const RaceResult& r) {
  return r.build.median() + r.render.median();
}

/// Fills the table of one variant; the three kinds of ratios are of rope trees against bsp.
struct Variant {
  Ratios speed, memory, build;
};

/// @param share  of what is left of the experiment: 1 over it
Result<Variant> measure_variant(Lab& lab, bool specular, int share, LabTable& table) {
  table.columns = {{"polygons", FigureForm::count},     {"memory M", FigureForm::bytes},
                   {"build TP", FigureForm::seconds},   {"render TR", FigureForm::seconds},
                   {"speedup S1", FigureForm::percent}, {"speedup S2", FigureForm::percent}};
  Variant variant;
  lab.expect_steps(share * race_steps(lab, structures.size()) * static_cast<int>(scenes.size()));
  for (const PolygonScene& s : scenes) {
    const Result<std::vector<RaceResult>> results = race_polygons(lab, s, specular);
    if (!results) return results.error();
    const RaceResult& bsp = results->front();
    note_differences(*results, table);
    for (const RaceResult& r : *results) {
      const Measured gain = speedup(bsp, r);
      const auto bytes = static_cast<double>(r.figures.memory_bytes);
      LabRow row{std::string(s.name) + ", " + r.name,
                 {counted(static_cast<double>(r.primitives)), counted(bytes), r.build_figure(), r.render_figure()}};
      if (&r == &bsp) {
        row.figures.insert(row.figures.end(), {LabFigure{}, LabFigure{}});
      } else {
        // A spread of a difference from 1 is not one of the difference.
        row.figures.push_back({gain.value - 1, 0, ""});
        row.figures.push_back({seconds_in_all(bsp) / seconds_in_all(r) - 1, 0, ""});
      }
      table.rows.push_back(std::move(row));
    }
    const RaceResult& trees = results->back();
    const Measured gain = speedup(bsp, trees);
    variant.speed.add(gain);
    variant.memory.add(
        {static_cast<double>(trees.figures.memory_bytes) / static_cast<double>(bsp.figures.memory_bytes), 0});
    variant.build.add({trees.build.median() / bsp.build.median(), trees.build.spread()});
  }
  return variant;
}

}  // namespace

Status run_rope_trees_diffuse(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "BSP, ropes and rope trees, diffuse surfaces";
  table.about =
      "Pictures of 320 x 240 at full effort; two lights with hard shadows. Depth "
      "20, 4 primitives a leaf, planes in the middle (Kaplan).";
  const Result<Variant> variant = measure_variant(lab, false, 1, table);
  if (!variant) return variant.error();
  // The spread of the time is that of the factor; of what it exceeds 1 by, it is larger.
  const Measured mean = variant->speed.mean();
  const double gain = mean.value - 1;
  table.claims = {judge(paper.claim("always"), variant->speed.least()),
                  judge(paper.claim("up-to-eight"), Measured{gain, mean.value * mean.spread / std::fabs(gain)}),
                  judge(paper.claim("memory"), variant->memory.mean()),
                  judge(paper.claim("build"), variant->build.mean())};
  return success();
}

Status run_rope_trees_specular(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "The same with specular surfaces";
  table.about =
      "All surfaces reflect 0.8 of the light, and rays are followed five deep. The paper prints no figures of it.";
  const Result<Variant> specular = measure_variant(lab, true, 2, table);
  if (!specular) return specular.error();
  // Measured again here, so that the two are of one time.
  LabTable diffuse_table;
  const Result<Variant> diffuse = measure_variant(lab, false, 1, diffuse_table);
  if (!diffuse) return diffuse.error();
  const Measured a = specular->speed.mean(), b = diffuse->speed.mean();
  table.claims = {judge(paper.claim("specular"), Measured{a.value / b.value, a.spread + b.spread})};
  return success();
}

}  // namespace tenon
