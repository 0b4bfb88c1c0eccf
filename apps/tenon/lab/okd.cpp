#include <algorithm>
#include <array>

#include "lab/experiments.h"
#include "lab/race.h"

namespace tenon {

namespace {

// The thesis takes 640 x 480; this is a quarter of the pixels, so that the lab ends in time (--scale 2 is the
// thesis's).
constexpr int width = 320, height = 240;

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
constexpr std::size_t nbvh = 0, okd_sah = 1, okd_msah = 2;

using Definitions = std::vector<std::pair<std::string, std::string>>;

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

Result<LabScene> read_model(Lab& lab, const std::string& model, Definitions more = {}) {
  more.emplace_back("model", quoted(model));
  return lab.read("lab/scenes/thesis.scad", lab.side(width), lab.side(height), more);
}

RenderOptions thesis_options() {
  RenderOptions options;
  options.integrator = IntegratorKind::path;
  options.samples = 8;
  options.depth = 20;
  return options;
}

/// A mesh that stands for a model, with the tree that is built when its file is read.
struct ReadMesh {
  std::optional<LabScene> scene;
  Timing reading;
};

Result<ReadMesh> read_mesh(Lab& lab, const std::string& model, const Definitions& definitions) {
  ReadMesh mesh;
  // What takes long is read once.
  for (int round = 0; round < 3 && (round == 0 || mesh.reading.seconds.front() < 0.5); ++round) {
    std::optional<Error> failed;
    mesh.reading.seconds.push_back(cpu_seconds([&] {
      Result<LabScene> scene = read_model(lab, model, definitions);
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
  const RaceResult& slowest_csg() const {
    return *std::max_element(all.begin(), all.begin() + 3, [](const RaceResult& a, const RaceResult& b) {
      return a.render.median() < b.render.median();
    });
  }
  std::optional<Measured> mesh_over_slowest() const {
    return has_mesh ? std::optional(speedup(mesh(), slowest_csg())) : std::nullopt;
  }
};

LabRow result_row(const std::string& name, const RaceResult& r, const RaceResult& base) {
  return {name, {r.build_figure(), r.render_figure(), counted(1 - 1 / speedup(base, r).value)}};
}

Result<ThesisResults> measure(Lab& lab, const ThesisTable& t, LabTable& table) {
  table.title = t.title;
  table.about =
      "Path traced with 8 samples a pixel and up to 20 surfaces along a path, 320 x 240 at full effort (the thesis: "
      "640 x "
      "480), six runs at full "
      "effort. Improvement is over the triangle mesh, or over the NBVH where there is none. A mesh's build "
      "time "
      "is that of reading its file and building its tree.";
  table.columns = {
      {"structure build", FigureForm::seconds}, {"render", FigureForm::seconds}, {"improvement", FigureForm::percent}};
  const Result<LabScene> solid = read_model(lab, t.model);
  if (!solid) return solid.error();
  std::vector<Contender> contenders;
  for (const Structure& s : structures) contenders.push_back({s.row, &*solid, s.accelerator});
  const std::string file = t.has_mesh ? lab.made_file(std::string(t.model) + ".off") : "";
  std::vector<ReadMesh> meshes;
  if (!file.empty()) {
    for (const char* local : {"kd", "bvh"}) {
      Result<ReadMesh> mesh = read_mesh(lab, t.model, {{"mesh", quoted(file)}, {"local", quoted(local)}});
      if (!mesh) return mesh.error();
      meshes.push_back(std::move(*mesh));
    }
    contenders.push_back({"Triangle Mesh", &*meshes[0].scene, "nbvh", true});
    contenders.push_back({"Triangle mesh, hierarchy of boxes", &*meshes[1].scene, "nbvh", true});
  }
  const int rounds = lab.effort().rounds + 1;
  lab.expect_steps(race_steps(lab, contenders.size(), rounds));
  Result<std::vector<RaceResult>> results = race(lab, contenders, thesis_options(), rounds);
  if (!results) return results.error();
  note_differences(*results, table);
  for (std::size_t i = 0; i < meshes.size(); ++i) (*results)[structures.size() + i].build = meshes[i].reading;

  ThesisResults found{std::move(*results), !meshes.empty()};
  const RaceResult& base = found.has_mesh ? found.mesh() : found.all[nbvh];
  if (found.has_mesh) {
    table.rows.push_back(result_row("Triangle Mesh", found.mesh(), base));
    table.rows.push_back(result_row(found.all.back().name, found.all.back(), base));
    table.notes.push_back("The mesh has " + lab.triangles_of(file) + " triangles.");
  } else if (t.has_mesh) {
    const LabFigure none{std::nullopt, 0, "no mesh"};
    table.rows.push_back({"Triangle Mesh", {none, none, none}});
    table.notes.push_back("There was no mesh; ./dev lab makes them.");
  }
  for (std::size_t i = 0; i < structures.size(); ++i) {
    table.rows.push_back(result_row(structures[i].row, found.all[i], base));
  }
  return found;
}

/// The kd-trees of both heuristics over a model alone.
Result<std::pair<AcceleratorFigures, AcceleratorFigures>> bare_trees(Lab& lab, const std::string& model) {
  const Result<LabScene> bare = read_model(lab, model, {{"bare", "true"}});
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
                  judge(paper.claim("grooved-msah"), speedup(r[okd_msah], r[okd_sah]))};
  return success();
}

Status run_okd_checkered_cube(Lab& lab, const Paper& paper, LabTable& table) {
  const auto found = measure(lab, {"checkered_cube", "Checkered cube", true}, table);
  if (!found) return found.error();
  const auto trees = bare_trees(lab, "checkered_cube");
  if (!trees) return trees.error();
  const auto& r = found->all;
  std::optional<Measured> build;
  if (found->has_mesh) {
    build = Measured{found->mesh().build.median() / r[okd_msah].build.median(), found->mesh().build.spread()};
  }
  table.claims = {judge(paper.claim("cube-mesh"), found->mesh_over_slowest()),
                  judge(paper.claim("cube-sah"), speedup(r[okd_sah], r[nbvh])),
                  judge(paper.claim("cube-msah"), speedup(r[nbvh], r[okd_msah])),
                  judge(paper.claim("cube-depth"),
                        Measured{static_cast<double>(trees->second.depth) / std::max(1, trees->first.depth), 0}),
                  judge(paper.claim("cube-build"), build)};
  return success();
}

Status run_okd_large_shell(Lab& lab, const Paper& paper, LabTable& table) {
  const auto found = measure(lab, {"large_shell", "Large shell", false}, table);
  if (!found) return found.error();
  const auto& r = found->all;
  table.claims = {judge(paper.claim("large-shell"), speedup(r[nbvh], r[okd_msah])),
                  judge(paper.claim("large-shell-msah"), speedup(r[okd_sah], r[okd_msah]))};
  return success();
}

Status run_okd_small_shell(Lab& lab, const Paper& paper, LabTable& table) {
  const auto found = measure(lab, {"small_shell", "Small shell", true}, table);
  if (!found) return found.error();
  const auto& r = found->all;
  table.claims = {judge(paper.claim("small-shell-mesh"), found->mesh_over_slowest()),
                  judge(paper.claim("small-shell-nbvh"), speedup(r[okd_msah], r[nbvh])),
                  judge(paper.claim("small-shell-msah"), speedup(r[okd_sah], r[okd_msah]))};
  return success();
}

Status run_okd_turns(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "The small shell's construction with more turns (§4.5)";
  table.about = "16 segments a turn, a lopsided tree. Path traced as above, 160 x 120 at full effort; time a ray.";
  LabPlot plot{"okd-turns", "The small shell's construction", "turns", "microseconds a ray", false, false, {}};
  for (const Structure& s : structures) {
    table.columns.push_back({s.row, FigureForm::seconds});
    plot.series.push_back({s.row, {}, {}, false});
  }
  table.columns.push_back({"NBVH over OKD-tree (MSAH)", FigureForm::times});
  constexpr std::array<int, 4> turns{1, 2, 3, 4};
  lab.expect_steps(race_steps(lab, structures.size()) * static_cast<int>(turns.size()));
  std::optional<Measured> least;
  for (const int n : turns) {
    const Result<LabScene> scene = lab.read("lab/scenes/thesis.scad", lab.side(width / 2), lab.side(height / 2),
                                            {{"model", quoted("small_shell")}, {"segments", std::to_string(16 * n)}});
    if (!scene) return scene.error();
    std::vector<Contender> contenders;
    for (const Structure& s : structures) contenders.push_back({s.row, &*scene, s.accelerator});
    const auto results = race(lab, contenders, thesis_options());
    if (!results) return results.error();
    note_differences(*results, table);
    LabRow row{std::to_string(n) + (n == 1 ? " turn" : " turns"), {}};
    for (std::size_t i = 0; i < results->size(); ++i) {
      row.figures.push_back((*results)[i].per_ray_figure());
      plot.series[i].x.push_back(n);
      plot.series[i].y.push_back(*row.figures.back().value * 1e6);
    }
    row.figures.push_back(speedup_figure((*results)[nbvh], (*results)[okd_msah]));
    table.rows.push_back(std::move(row));
    const Measured ratio = speedup((*results)[nbvh], (*results)[okd_msah]);
    if (n > 1 && (!least || ratio.value < least->value)) least = ratio;
  }
  table.claims = {judge(paper.claim("turns"), least)};
  table.plots = {std::move(plot)};
  return success();
}

Status run_okd_finer(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "The finer meshes that specular surfaces need";
  table.about =
      "The grooved sphere as a mirror (0.9 reflected, rays followed 5 deep, whitted), 320 x 240 at full effort: the "
      "solid by `cells` and `nbvh`, and meshes of ever more triangles. Pixels count as different when a "
      "component of their light is off by more than 1/255.";
  table.columns = {{"triangles", FigureForm::count},
                   {"reading or building", FigureForm::seconds},
                   {"render", FigureForm::seconds},
                   {"different pixels", FigureForm::percent}};
  const Result<LabScene> solid = read_model(lab, "grooved_sphere", {{"specular", "true"}});
  if (!solid) return solid.error();
  std::vector<Contender> contenders{{"the solid, cells", &*solid, "cells:threads=1"},
                                    {"the solid, nbvh", &*solid, "nbvh"}};
  std::vector<std::string> files;
  std::vector<ReadMesh> meshes;
  for (const char* name : {"grooved_sphere", "grooved_sphere_fine", "grooved_sphere_finest"}) {
    const std::string file = lab.made_file(std::string(name) + ".off");
    if (file.empty()) continue;
    Result<ReadMesh> mesh = read_mesh(lab, "grooved_sphere", {{"specular", "true"}, {"mesh", quoted(file)}});
    if (!mesh) return mesh.error();
    meshes.push_back(std::move(*mesh));
    files.push_back(file);
  }
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    contenders.push_back({"mesh of " + lab.triangles_of(files[i]), &*meshes[i].scene, "nbvh", true});
  }
  RenderOptions options;
  options.depth = 5;
  lab.expect_steps(race_steps(lab, contenders.size()));
  const auto results = race(lab, contenders, options);
  if (!results) return results.error();
  note_differences(*results, table);
  std::optional<Measured> different;
  for (std::size_t i = 0; i < results->size(); ++i) {
    const RaceResult& r = (*results)[i];
    const bool is_mesh = i >= 2;
    const double share = share_of_different_pixels(results->front().picture, r.picture, 1.0 / 255);
    LabFigure triangles;
    LabFigure build = r.build_figure();
    if (is_mesh) {
      triangles = counted(std::stod(lab.triangles_of(files[i - 2])));
      build = {meshes[i - 2].reading.median(), meshes[i - 2].reading.spread(), ""};
      if (!different) different = Measured{100 * share, 0};
    }
    table.rows.push_back({r.name, {triangles, build, r.render_figure(), counted(share)}});
  }
  if (meshes.empty()) table.notes.push_back("There were no meshes; ./dev lab makes them.");
  table.claims = {judge(paper.claim("finer"), different)};
  return success();
}

}  // namespace tenon
