#include <array>

#include "lab/experiments.h"
#include "lab/race.h"
#include "lab/ratios.h"

namespace tenon {

namespace {

// A hundred to a thousand primitives each, so that structures matter and `none` ends in time.
constexpr std::array<const char*, 4> scenes{"checkered_cube", "gear_plate", "swiss_cheese", "large_shell"};
constexpr int width = 160, height = 120;
// Of what takes longer.
constexpr int half_width = width / 2, half_height = height / 2;

std::string bench_path(const std::string& name) {
  return "scenes/bench/" + name + ".scad";
}

const std::vector<LabColumn> structure_columns{{"build", FigureForm::seconds},      {"memory", FigureForm::bytes},
                                               {"time a ray", FigureForm::seconds}, {"tests a ray", FigureForm::number},
                                               {"cells a ray", FigureForm::number}, {"mailbox", FigureForm::percent}};

LabRow structure_row(const std::string& scene, const RaceResult& r) {
  const double cells_a_ray = static_cast<double>(r.statistics.total().cells_visited) / r.rays();
  return {scene + ", " + r.name,
          {timed(r.build_time()), counted(r.memory_bytes()), timed(r.time_a_ray()), counted(r.tests_a_ray()),
           counted(cells_a_ray), counted(mailbox_share(r.statistics))}};
}

/// The same structures on every scene; `then` gets what came of each.
Status compare_structures(Lab& lab, const std::vector<std::string>& specs, LabTable& table,
                          FunctionRef<void(const std::vector<RaceResult>&)> then) {
  table.columns = structure_columns;
  lab.expect_steps(race_steps(lab, specs.size()) * static_cast<int>(scenes.size()));
  for (const char* name : scenes) {
    const Result<LabScene> scene = lab.read(bench_path(name), width, height);
    if (!scene) return scene.error();
    const auto results = race(lab, structures_over(*scene, specs), {}, table);
    if (!results) return results.error();
    for (const RaceResult& r : *results) table.rows.push_back(structure_row(name, r));
    then(*results);
  }
  return success();
}

/// A variable of a scene that chooses a method, and its values.
struct Variants {
  std::string name;  ///< of the row
  std::string path;
  std::vector<std::pair<std::string, Definitions>> choices;  ///< the first is what others are held against
  bool is_approximate = false;                               ///< methods may differ in the picture
};

/// One scene by several methods of its primitives, under `cells`, each a column.
Status compare_methods(Lab& lab, const Variants& variants, LabTable& table, int picture_width, int picture_height) {
  std::vector<LabScene> read;
  for (const auto& [name, definitions] : variants.choices) {
    Result<LabScene> scene = lab.read(variants.path, picture_width, picture_height, definitions);
    if (!scene) return scene.error();
    read.push_back(std::move(*scene));
  }
  std::vector<Contender> contenders;
  for (std::size_t i = 0; i < read.size(); ++i) {
    contenders.push_back({variants.choices[i].first, &read[i], "nbvh", variants.is_approximate});
  }
  const auto results = race(lab, contenders, {}, table);
  if (!results) return results.error();
  LabRow row{variants.name, {}};
  for (const RaceResult& r : *results) row.figures.push_back(timed(r.time_a_ray()));
  for (std::size_t i = 1; i < results->size(); ++i) {
    const RaceResult& r = (*results)[i];
    row.figures.push_back(timed(speedup(r, results->front())));
    if (!variants.is_approximate) continue;
    row.figures.push_back(counted(share_of_different_pixels(results->front().picture, r.picture, visible_difference)));
  }
  table.rows.push_back(std::move(row));
  return success();
}

void method_columns(const std::vector<std::string>& methods, bool is_approximate, LabTable& table) {
  for (const std::string& m : methods) table.columns.push_back({m, FigureForm::seconds});
  for (std::size_t i = 1; i < methods.size(); ++i) {
    table.columns.push_back({methods[i] + " over " + methods.front(), FigureForm::times});
    if (is_approximate) table.columns.push_back({"its different pixels", FigureForm::percent});
  }
}

std::string about_structures(const Lab& lab) {
  return "Pictures of " + lab.pixels(width, height) +
         ", with shadow rays; the bench's scenes of 151 to 1,001 primitives.";
}
std::string about_methods(const Lab& lab, int picture_width, int picture_height) {
  return "Time a ray of whole pictures, " + lab.pixels(picture_width, picture_height) +
         ", shadow rays included, with NBVH above the primitives.";
}
constexpr const char* about_different_pixels =
    " Pixels are different where a component of their light is off by more than 1/255 from the first column's.";

}  // namespace

Status run_course_hierarchies(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Median cut, Goldsmith and Salmon, SAH";
  table.about = about_structures(lab) +
                " SAH is that of the OKD-tree and of the BSP tree (MacDonald and Booth): "
                "there is no hierarchy of boxes by SAH among the papers' structures.";
  Ratios hierarchy, goldsmith, sah;
  const Status status =
      compare_structures(lab, {"none", "median-bvh", "goldsmith-bvh", "okd:split=sah", "bsp:split=macdonald-booth"},
                         table, [&](const std::vector<RaceResult>& r) {
                           hierarchy.add(speedup(r[0], r[1]));
                           goldsmith.add(speedup(r[1], r[2]));
                           sah.add(speedup(r[1], r[3]));
                         });
  if (!status) return status;
  table.claims = {judge(paper.claim("hierarchy"), hierarchy.least()), judge(paper.claim("goldsmith"), goldsmith.mean()),
                  judge(paper.claim("sah"), sah.mean())};
  return success();
}

Status run_course_volumes(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Bounding volumes: boxes, spheres, ellipsoids, slabs";
  table.about = about_structures(lab) +
                " Median cut; `filter` sorts primary rays out by the volumes' rectangles on "
                "the screen.";
  Ratios filter, polyhedron;
  const Status status =
      compare_structures(lab,
                         {"median-bvh:volume=box", "median-bvh:volume=box,filter=on", "median-bvh:volume=sphere",
                          "median-bvh:volume=ellipsoid", "median-bvh:volume=slabs"},
                         table, [&](const std::vector<RaceResult>& r) {
                           filter.add(speedup(r[0], r[1]));
                           polyhedron.add({r[0].tests_a_ray() / r[4].tests_a_ray(), 0});
                         });
  if (!status) return status;
  table.claims = {judge(paper.claim("filter"), filter.mean()), judge(paper.claim("polyhedron"), polyhedron.mean())};
  return success();
}

Status run_course_steps(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "The uniform grid: the classical step against Amanatides's";
  table.about = about_structures(lab) +
                " A ray takes few steps through the grid that is chosen by the number of primitives; so there is one "
                "of 100 x 100 x 100 cells, too, where steps matter.";
  Ratios ratios;
  const Status status = compare_structures(lab,
                                           {"grid:step=classic", "grid:step=amanatides",
                                            "grid:step=classic,resolution=100", "grid:step=amanatides,resolution=100"},
                                           table, [&](const auto& r) { ratios.add(speedup(r[2], r[3])); });
  if (!status) return status;
  table.claims = {judge(paper.claim("amanatides"), ratios.mean())};
  return success();
}

Status run_course_grids(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Uniform grid, non-uniform grid, space tracing's projected trees";
  table.about = about_structures(lab);
  Ratios ratios;
  const Status status =
      compare_structures(lab, {"grid", "nonuniform-grid", "space-tracing"}, table, [&](const auto& r) {
        ratios.add({r[0].tests_a_ray() / r[1].tests_a_ray(), 0});
      });
  if (!status) return status;
  table.claims = {judge(paper.claim("few-objects"), ratios.mean())};
  return success();
}

Status run_course_polygons(Lab& lab, const Paper&, LabTable& table) {
  table.title = "Polygons: Snyder's test against Marchal's";
  table.about = about_methods(lab, width, height) +
                " 400 stars (`lab/scenes/stars.scad`). The course calls neither the "
                "faster. Both share what takes most of the time: to find the polygon, and to ask whether the point is "
                "too near to an edge for either test to be certain.";
  method_columns({"snyder", "marchal"}, false, table);
  constexpr std::array<int, 4> corners{3, 8, 32, 128};
  lab.expect_steps(race_steps(lab, 2) * static_cast<int>(corners.size()));
  for (const int n : corners) {
    Variants variants{std::to_string(n) + " corners", "lab/scenes/stars.scad", {}, false};
    for (const std::string method : {"snyder", "marchal"}) {
      variants.choices.emplace_back(method, Definitions{{"corners", std::to_string(n)}, {"method", quoted(method)}});
    }
    if (Status status = compare_methods(lab, variants, table, width, height); !status) return status;
  }
  return success();
}

Status run_course_roots(Lab& lab, const Paper&, LabTable& table) {
  table.title = "Algebraic surfaces: isolation of roots, and their refinement";
  table.about = about_methods(lab, half_width, half_height) +
                " Isolation by intervals or by Collins's method, then Newton's, Laguerre's or "
                "Bairstow's iteration. The course calls none the fastest." +
                about_different_pixels;
  const std::array<std::pair<const char*, const char*>, 4> methods{
      {{"interval", "newton"}, {"collins", "newton"}, {"interval", "laguerre"}, {"interval", "bairstow"}}};
  std::vector<std::string> names;
  for (const auto& [isolation, refinement] : methods) names.push_back(std::string(isolation) + ", " + refinement);
  method_columns(names, true, table);
  const std::array<std::pair<const char*, const char*>, 4> surfaces{{{"Cayley's cubic, degree 3", "cayley"},
                                                                     {"Steiner's surface, degree 4", "steiner"},
                                                                     {"Heart, degree 6", "heart"},
                                                                     {"Barth's sextic, degree 6", "barth_sextic"}}};
  lab.expect_steps(race_steps(lab, methods.size()) * static_cast<int>(surfaces.size()));
  for (const auto& [name, file] : surfaces) {
    // Newton's iteration and the others end within the same bound, not at the same number.
    Variants variants{name, "scenes/" + std::string(file) + ".scad", {}, true};
    for (std::size_t i = 0; i < methods.size(); ++i) {
      variants.choices.emplace_back(
          names[i], Definitions{{"isolation", quoted(methods[i].first)}, {"refinement", quoted(methods[i].second)}});
    }
    if (Status status = compare_methods(lab, variants, table, half_width, half_height); !status) return status;
  }
  return success();
}

Status run_course_patches(Lab& lab, const Paper&, LabTable& table) {
  table.title = "Bicubic patches: polygons, subdivision, numerical methods";
  table.about = about_methods(lab, half_width, half_height) +
                " Newell's teapot, 32 patches. `interval` and `resultant` (Kajiya) find the patch itself; subdivision "
                "ends at parts of 0.001, polygons are 16 x 16 a patch. The course calls none the fastest." +
                about_different_pixels;
  const std::vector<std::string> methods{"interval", "resultant", "subdivision", "polygons"};
  method_columns(methods, true, table);
  Variants variants{"Newell's teapot", "scenes/teapot.scad", {}, true};
  for (const std::string& m : methods) variants.choices.emplace_back(m, Definitions{{"method", quoted(m)}});
  lab.expect_steps(race_steps(lab, methods.size()));
  return compare_methods(lab, variants, table, half_width, half_height);
}

}  // namespace tenon
