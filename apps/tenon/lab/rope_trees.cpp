#include <array>

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
constexpr std::size_t cylinder_100 = 1, cylinder_10000 = 2;
constexpr std::array<PolygonScene, 8> scenes{{{"Octagon", "octagon"},
                                              {"Cylinder 100", "cylinder_100"},
                                              {"Cylinder 10000", "cylinder_10000"},
                                              {"Teapot", "teapot"},
                                              {"Banana", "banana"},
                                              {"Eagle", "eagle"},
                                              {"Small random triangles", "small_triangles"},
                                              {"Large random triangles", "large_triangles"}}};
/// A structure, as the rows call it.
struct Structure {
  const char* row;
  const char* accelerator;
};
constexpr std::array<Structure, 4> structures{
    {{"bsp", "bsp:depth=20,leaf=4"},
     {"ropes", "ropes:depth=20,leaf=4"},
     {"rope-trees", "rope-trees:depth=20,leaf=4"},
     {"bsp by MacDonald and Booth", "bsp:depth=20,leaf=4,split=macdonald-booth"}}};
// Where they stand in the results.
constexpr std::size_t bsp = 0, rope_trees = 2, macdonald_booth = 3;
constexpr int width = 320, height = 240;
constexpr int specular_depth = 5;

/// Which surfaces, and how many of the structures.
struct VariantRules {
  bool specular = false;
  std::size_t structures = rope_trees + 1;
};

/// One scene with the structures in their order.
Result<std::vector<RaceResult>> race_polygons(Lab& lab, const PolygonScene& s, const VariantRules& variant,
                                              LabTable& table) {
  const Result<LabScene> scene =
      lab.read("lab/scenes/rope_trees.scad", width, height,
               {{"model", quoted(s.model)}, {"specular", variant.specular ? "true" : "false"}});
  if (!scene) return scene.error();
  std::vector<Contender> contenders;
  for (std::size_t i = 0; i < variant.structures; ++i) {
    contenders.push_back({structures[i].row, &*scene, structures[i].accelerator});
  }
  RaceRules rules;
  rules.options.depth = variant.specular ? specular_depth : 1;
  return race(lab, contenders, rules, table);
}

double seconds_in_all(const RaceResult& r) {
  return r.build.median() + r.render.median();
}

/// What came of all scenes: of rope trees against bsp, and of planes by MacDonald and Booth against those in the
/// middle.
struct Variant {
  std::vector<Measured> speeds;  ///< by scene
  Ratios speed, memory, build, macdonald_booth;
};

/// @param share  of what is left of the experiment: 1 over it
Result<Variant> measure_variant(Lab& lab, const VariantRules& rules, int share, LabTable& table) {
  table.columns = {{"polygons", FigureForm::count},     {"memory M", FigureForm::bytes},
                   {"build TP", FigureForm::seconds},   {"render TR", FigureForm::seconds},
                   {"speedup S1", FigureForm::percent}, {"speedup S2", FigureForm::percent}};
  Variant variant;
  lab.expect_steps(share * race_steps(lab, rules.structures) * static_cast<int>(scenes.size()));
  for (const PolygonScene& s : scenes) {
    const Result<std::vector<RaceResult>> results = race_polygons(lab, s, rules, table);
    if (!results) return results.error();
    const RaceResult &base = (*results)[bsp], &trees = (*results)[rope_trees];
    for (const RaceResult& r : *results) {
      LabRow row{std::string(s.name) + ", " + r.name,
                 {counted(static_cast<double>(r.primitives)), counted(r.memory_bytes()), timed(r.build_time()),
                  timed(r.render_time())}};
      if (&r == &base) {
        row.figures.insert(row.figures.end(), {LabFigure{}, LabFigure{}});
      } else {
        // A spread of a difference from 1 is not one of the difference.
        row.figures.push_back(counted(speedup(base, r).value - 1));
        row.figures.push_back(counted(seconds_in_all(base) / seconds_in_all(r) - 1));
      }
      table.rows.push_back(std::move(row));
    }
    variant.speeds.push_back(speedup(base, trees));
    variant.speed.add(variant.speeds.back());
    variant.memory.add({trees.memory_bytes() / base.memory_bytes(), 0});
    variant.build.add(divided(trees.build_time(), base.build_time()));
    if (rules.structures > macdonald_booth) {
      variant.macdonald_booth.add(speedup(base, (*results)[macdonald_booth]));
    }
  }
  return variant;
}

}  // namespace

Status run_rope_trees_diffuse(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "BSP, ropes and rope trees, diffuse surfaces";
  table.about = "Pictures of " + lab.pixels(width, height) +
                "; two lights with hard shadows. Depth 20, 4 primitives a leaf, planes in the middle (Kaplan) where "
                "nothing else is said.";
  const Result<Variant> variant = measure_variant(lab, {false, structures.size()}, 1, table);
  if (!variant) return variant.error();
  table.claims = {judge(paper.claim("always"), variant->speed.least()),
                  judge(paper.claim("up-to-eight"), variant->speed.mean()),
                  judge(paper.claim("size"), divided(variant->speeds[cylinder_10000], variant->speeds[cylinder_100])),
                  judge(paper.claim("memory"), variant->memory.mean()),
                  judge(paper.claim("build"), variant->build.mean()),
                  judge(paper.claim("macdonald-booth"), variant->macdonald_booth.mean())};
  return success();
}

Status run_rope_trees_specular(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "The same with specular surfaces";
  table.about =
      "All surfaces reflect 0.8 of the light, and rays are followed five deep; else as above. The paper prints no "
      "figures of it.";
  const Result<Variant> specular = measure_variant(lab, {.specular = true}, 2, table);
  if (!specular) return specular.error();
  // Measured again here, so that the two are of one time.
  LabTable diffuse_table;
  const Result<Variant> diffuse = measure_variant(lab, {}, 1, diffuse_table);
  if (!diffuse) return diffuse.error();
  table.claims = {judge(paper.claim("specular"), divided(specular->speed.mean(), diffuse->speed.mean()))};
  return success();
}

}  // namespace tenon
