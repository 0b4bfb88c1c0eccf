#include <algorithm>
#include <array>

#include "lab/experiments.h"
#include "lab/race.h"
#include "lab/ratios.h"

namespace tenon {

namespace {

// The thesis's pictures, and smaller ones where it prints no figures.
constexpr int width = 640, height = 480;
constexpr int half_width = width / 2, half_height = height / 2;
constexpr int quarter_width = width / 4, quarter_height = height / 4;

struct Structure {
  const char* row;  ///< as the thesis calls it
  const char* accelerator;
};
constexpr std::array<Structure, 5> structures{{{"CSG with NBVH", "nbvh"},
                                               {"CSG with OKD-tree (SAH)", "okd:split=sah"},
                                               {"CSG with OKD-tree (MSAH)", "okd:split=msah"},
                                               {"multi-kd", "multi-kd"},
                                               {"cells", "cells:threads=1"}}};
// Where they stand in the results.
constexpr std::size_t nbvh = 0, okd_sah = 1, okd_msah = 2, multi_kd = 3;

Result<LabScene> read_model(const Lab& lab, const std::string& model, int picture_width, int picture_height,
                            Definitions more = {}) {
  more.emplace_back("model", quoted(model));
  return lab.read("lab/scenes/thesis.scad", picture_width, picture_height, more);
}

RaceRules thesis_rules() {
  RaceRules rules;
  rules.options.integrator = IntegratorKind::path;
  rules.options.samples = 8;
  rules.options.depth = 20;
  return rules;
}

/// A mesh that stands for a model, with the tree that is built when its file is read.
struct ReadMesh {
  std::optional<LabScene> scene;
  Timing reading;
};

Result<ReadMesh> read_mesh(const Lab& lab, const std::string& model, int picture_width, int picture_height,
                           const Definitions& definitions) {
  ReadMesh mesh;
  // What takes long is read once.
  for (int round = 0; round < 3 && (round == 0 || mesh.reading.seconds.front() < 0.5); ++round) {
    std::optional<Error> failed;
    mesh.reading.seconds.push_back(cpu_seconds([&] {
      Result<LabScene> scene = read_model(lab, model, picture_width, picture_height, definitions);
      if (!scene) return void(failed = scene.error());
      mesh.scene.emplace(std::move(*scene));
    }));
    if (failed) return *failed;
  }
  return mesh;
}

/// What one of the thesis's tables is about.
struct ThesisTable {
  const char* model;
  const char* title;
  bool has_mesh;
};

/// The contenders of a table, in the order of `structures`, the meshes behind them.
struct ThesisResults {
  std::vector<RaceResult> all;
  bool has_mesh = false;

  const RaceResult& mesh() const { return all[structures.size()]; }
  std::optional<Measured> mesh_over_slowest() const {
    return has_mesh ? std::optional(speedup(mesh(), *slowest(&RaceResult::render))) : std::nullopt;
  }
  std::optional<Measured> mesh_over_slowest_build() const {
    if (!has_mesh) return std::nullopt;
    return divided(mesh().build_time(), slowest(&RaceResult::build)->build_time());
  }

 private:
  // Of the thesis's own.
  std::vector<RaceResult>::const_iterator slowest(Timing RaceResult::*what) const {
    return std::max_element(all.begin(), all.begin() + 3, [&](const RaceResult& a, const RaceResult& b) {
      return (a.*what).median() < (b.*what).median();
    });
  }
};

/// @param is_mesh  to the structure it is one primitive: what it counts says nothing
LabRow result_row(const std::string& name, const RaceResult& r, const RaceResult& base, bool is_mesh) {
  return {name,
          {timed(r.build_time()), timed(r.render_time()), counted(1 - 1 / speedup(base, r).value),
           is_mesh ? LabFigure{} : counted(r.memory_bytes()), is_mesh ? LabFigure{} : counted(r.tests_a_ray())}};
}

Result<ThesisResults> measure(Lab& lab, const ThesisTable& t, LabTable& table) {
  RaceRules rules = thesis_rules();
  rules.rounds = lab.effort().rounds + 1;
  rules.threads = 2;  // so that the lab ends in time
  table.title = t.title;
  table.about = "Path traced with 8 samples a pixel and up to 20 surfaces along a path, " + lab.pixels(width, height) +
                ", " + std::to_string(rules.rounds) +
                " runs, by two threads whose CPU times are added up. Improvement is over the triangle mesh, or over "
                "the NBVH where there is none. A mesh's build time is that of reading its file and building its tree.";
  table.columns = {{"structure build", FigureForm::seconds},
                   {"render", FigureForm::seconds},
                   {"improvement", FigureForm::percent},
                   {"memory", FigureForm::bytes},
                   {"tests a ray", FigureForm::number}};
  const Result<LabScene> solid = read_model(lab, t.model, width, height);
  if (!solid) return solid.error();
  std::vector<Contender> contenders;
  for (const Structure& s : structures) contenders.push_back({s.row, &*solid, s.accelerator});
  const std::string file = t.has_mesh ? lab.made_file(std::string(t.model) + ".off") : "";
  std::vector<ReadMesh> meshes;
  if (!file.empty()) {
    for (const char* local : {"kd", "bvh"}) {
      Result<ReadMesh> mesh =
          read_mesh(lab, t.model, width, height, {{"mesh", quoted(file)}, {"local", quoted(local)}});
      if (!mesh) return mesh.error();
      meshes.push_back(std::move(*mesh));
    }
    contenders.push_back({"Triangle Mesh", &*meshes[0].scene, "nbvh", true});
    contenders.push_back({"Triangle mesh, hierarchy of boxes", &*meshes[1].scene, "nbvh", true});
  }
  lab.expect_steps(race_steps(lab, contenders.size(), rules.rounds));
  Result<std::vector<RaceResult>> results = race(lab, contenders, rules, table);
  if (!results) return results.error();
  for (std::size_t i = 0; i < meshes.size(); ++i) (*results)[structures.size() + i].build = meshes[i].reading;

  ThesisResults found{std::move(*results), !meshes.empty()};
  const RaceResult& base = found.has_mesh ? found.mesh() : found.all[nbvh];
  if (found.has_mesh) {
    table.rows.push_back(result_row("Triangle Mesh", found.mesh(), base, true));
    table.rows.push_back(result_row(found.all.back().name, found.all.back(), base, true));
    table.notes.push_back("The mesh has " + lab.triangles_of(file) + " triangles, the solid " +
                          std::to_string(found.all.front().primitives) + " primitives, the ground among them.");
  } else if (t.has_mesh) {
    const LabFigure none{std::nullopt, 0, "no mesh"};
    table.rows.push_back({"Triangle Mesh", std::vector<LabFigure>(table.columns.size(), none)});
    table.notes.push_back("There was no mesh; ./dev lab makes them.");
  }
  for (std::size_t i = 0; i < structures.size(); ++i) {
    table.rows.push_back(result_row(structures[i].row, found.all[i], base, false));
  }
  return found;
}

/// The kd-trees of both heuristics over a model alone.
Result<std::pair<AcceleratorFigures, AcceleratorFigures>> bare_trees(Lab& lab, const std::string& model) {
  const Result<LabScene> bare = read_model(lab, model, width, height, {{"bare", "true"}});
  if (!bare) return bare.error();
  const auto sah = build_accelerator(structures[okd_sah].accelerator, *bare->scene.tree);
  if (!sah) return sah.error();
  const auto msah = build_accelerator(structures[okd_msah].accelerator, *bare->scene.tree);
  if (!msah) return msah.error();
  return std::pair((*sah)->figures(), (*msah)->figures());
}

}  // namespace

Status run_okd_grooved_sphere(Lab& lab, const Paper& paper, LabTable& table) {
  const auto found = measure(lab, {"grooved_sphere", "Grooved sphere", true}, table);
  if (!found) return found.error();
  const auto trees = bare_trees(lab, "grooved_sphere");
  if (!trees) return trees.error();
  const auto& r = found->all;
  table.claims = {judge(paper.claim("grooved-mesh"), found->mesh_over_slowest()),
                  judge(paper.claim("grooved-nbvh"), speedup(r[okd_sah], r[nbvh])),
                  judge(paper.claim("grooved-degenerate"),
                        Measured{static_cast<double>(std::max(trees->first.boxes, trees->second.boxes)), 0}),
                  judge(paper.claim("grooved-msah"), speedup(r[okd_msah], r[okd_sah])),
                  judge(paper.claim("grooved-build"), found->mesh_over_slowest_build())};
  return success();
}

Status run_okd_checkered_cube(Lab& lab, const Paper& paper, LabTable& table) {
  const auto found = measure(lab, {"checkered_cube", "Checkered cube", true}, table);
  if (!found) return found.error();
  const auto trees = bare_trees(lab, "checkered_cube");
  if (!trees) return trees.error();
  const auto& r = found->all;
  table.claims = {judge(paper.claim("cube-mesh"), found->mesh_over_slowest()),
                  judge(paper.claim("cube-sah"), speedup(r[okd_sah], r[nbvh])),
                  judge(paper.claim("cube-msah"), speedup(r[nbvh], r[okd_msah])),
                  judge(paper.claim("cube-depth"),
                        Measured{static_cast<double>(trees->second.depth) / std::max(1, trees->first.depth), 0}),
                  judge(paper.claim("cube-build"), found->mesh_over_slowest_build())};
  return success();
}

Status run_okd_large_shell(Lab& lab, const Paper& paper, LabTable& table) {
  const auto found = measure(lab, {"large_shell", "Large shell", false}, table);
  if (!found) return found.error();
  const auto& r = found->all;
  table.claims = {
      judge(paper.claim("large-shell"), speedup(r[nbvh], r[okd_msah])),
      judge(paper.claim("large-shell-msah"), speedup(r[okd_sah], r[okd_msah])),
      judge(paper.claim("multi-kd-memory"), Measured{r[multi_kd].memory_bytes() / r[okd_msah].memory_bytes(), 0})};
  return success();
}

Status run_okd_small_shell(Lab& lab, const Paper& paper, LabTable& table) {
  const auto found = measure(lab, {"small_shell", "Small shell", true}, table);
  if (!found) return found.error();
  const auto& r = found->all;
  table.claims = {judge(paper.claim("small-shell-mesh"), found->mesh_over_slowest()),
                  judge(paper.claim("small-shell-nbvh"), speedup(r[okd_msah], r[nbvh])),
                  judge(paper.claim("small-shell-msah"), speedup(r[okd_sah], r[okd_msah])),
                  judge(paper.claim("small-shell-build"), found->mesh_over_slowest_build())};
  return success();
}

Status run_okd_turns(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "The small shell's construction with more turns (§4.5)";
  table.about = "16 segments a turn, a lopsided tree. Path traced as above, " +
                lab.pixels(quarter_width, quarter_height) + ", by one thread; time a ray.";
  LabPlot plot{"okd-turns", "The small shell's construction", "turns", "microseconds a ray", false, false, {}};
  for (const Structure& s : structures) {
    table.columns.push_back({s.row, FigureForm::seconds});
    plot.series.push_back({s.row, {}, {}, false});
  }
  table.columns.push_back({"NBVH over OKD-tree (MSAH)", FigureForm::times});
  constexpr std::array<int, 4> turns{1, 2, 3, 4};
  lab.expect_steps(race_steps(lab, structures.size()) * static_cast<int>(turns.size()));
  Ratios gains;
  for (const int n : turns) {
    const Result<LabScene> scene =
        read_model(lab, "small_shell", quarter_width, quarter_height, {{"segments", std::to_string(16 * n)}});
    if (!scene) return scene.error();
    std::vector<Contender> contenders;
    for (const Structure& s : structures) contenders.push_back({s.row, &*scene, s.accelerator});
    const auto results = race(lab, contenders, thesis_rules(), table);
    if (!results) return results.error();
    LabRow row{std::to_string(n) + (n == 1 ? " turn" : " turns"), {}};
    for (std::size_t i = 0; i < results->size(); ++i) {
      const Measured time = (*results)[i].time_a_ray();
      row.figures.push_back(timed(time));
      plot.series[i].x.push_back(n);
      plot.series[i].y.push_back(time.value * 1e6);
    }
    const Measured gain = speedup((*results)[nbvh], (*results)[okd_msah]);
    row.figures.push_back(timed(gain));
    table.rows.push_back(std::move(row));
    if (n > 1) gains.add(gain);
  }
  table.claims = {judge(paper.claim("turns"), gains.least())};
  table.plots = {std::move(plot)};
  return success();
}

Status run_okd_finer(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "The finer meshes that specular surfaces need";
  table.about = "The grooved sphere as a mirror (0.9 reflected, rays followed 5 deep, whitted), " +
                lab.pixels(half_width, half_height) +
                ": the solid by `cells` and `nbvh`, and meshes of ever more triangles. Pixels count as different when "
                "a component of their light is off by more than 1/255.";
  table.columns = {{"triangles", FigureForm::count},
                   {"reading or building", FigureForm::seconds},
                   {"render", FigureForm::seconds},
                   {"different pixels", FigureForm::percent}};
  const char* const model = "grooved_sphere";
  const Result<LabScene> solid = read_model(lab, model, half_width, half_height, {{"specular", "true"}});
  if (!solid) return solid.error();
  std::vector<Contender> contenders{{"the solid, cells", &*solid, "cells:threads=1"},
                                    {"the solid, nbvh", &*solid, "nbvh"}};
  const std::size_t solids = contenders.size();
  std::vector<std::string> triangles;
  std::vector<ReadMesh> meshes;
  for (const char* name : {"grooved_sphere", "grooved_sphere_fine", "grooved_sphere_finest"}) {
    const std::string file = lab.made_file(std::string(name) + ".off");
    if (file.empty()) continue;
    Result<ReadMesh> mesh =
        read_mesh(lab, model, half_width, half_height, {{"specular", "true"}, {"mesh", quoted(file)}});
    if (!mesh) return mesh.error();
    meshes.push_back(std::move(*mesh));
    triangles.push_back(lab.triangles_of(file));
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    contenders.push_back({"mesh of " + triangles[i], &*meshes[i].scene, "nbvh", true});
  }
  RaceRules rules;
  rules.options.depth = 5;
  lab.expect_steps(race_steps(lab, contenders.size()));
  auto results = race(lab, contenders, rules, table);
  if (!results) return results.error();
  std::optional<Measured> of_coarsest;
  for (std::size_t i = 0; i < results->size(); ++i) {
    RaceResult& r = (*results)[i];
    const double share = share_of_different_pixels(results->front().picture, r.picture, visible_difference);
    LabFigure count;
    if (i >= solids) {
      count = counted(std::stod(triangles[i - solids]));
      r.build = meshes[i - solids].reading;
      if (!of_coarsest) of_coarsest = Measured{100 * share, 0};
    }
    table.rows.push_back({r.name, {count, timed(r.build_time()), timed(r.render_time()), counted(share)}});
  }
  if (meshes.empty()) table.notes.push_back("There were no meshes; ./dev lab makes them.");
  table.claims = {judge(paper.claim("finer"), of_coarsest)};
  return success();
}

}  // namespace tenon
