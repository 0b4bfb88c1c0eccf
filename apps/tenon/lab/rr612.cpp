#include <algorithm>
#include <array>
#include <cctype>

#include "lab/experiments.h"
#include "lab/race.h"
#include "lab/ratios.h"

namespace tenon {

namespace {

/// A scene of the paper, as its tables 1 and 2 use it.
struct PaperScene {
  const char* name;
  const char* path;
  int side;   ///< of the picture of table 2
  int depth;  ///< of the tree of rays
  int level, primitives;
};
constexpr std::array<PaperScene, 3> scenes{{{"IMA1", "scenes/ima1.scad", 512, 1, 4, 2},
                                            {"IMA2", "scenes/ima2.scad", 512, 1, 4, 2},
                                            {"IMA3", "scenes/ima3.scad", 256, 5, 3, 3}}};
constexpr int small_side = 256;

std::string space_tracing(int level, int primitives) {
  return "space-tracing:levels=" + std::to_string(level) + ",primitives=" + std::to_string(primitives) + ",axes=eye";
}

RenderOptions course_options(int depth) {
  RenderOptions options;
  options.depth = depth;
  return options;
}

/// One scene, traditional ray tracing against space tracing at one level or several.
Result<std::vector<RaceResult>> race_scene(Lab& lab, const LabScene& scene, int depth,
                                           const std::vector<std::string>& specs) {
  std::vector<Contender> contenders;
  for (const std::string& spec : specs) contenders.push_back({spec, &scene, spec});
  return race(lab, contenders, course_options(depth));
}

double tests_a_ray(const RaceResult& r) {
  return static_cast<double>(r.statistics.total().primitive_tests) / r.rays();
}

}  // namespace

Status run_rr612_scenes(Lab& lab, const Paper&, LabTable& table) {
  table.title = "The scenes";
  table.about = "Made to the paper's descriptions. What is counted is in the files.";
  table.columns = {{"primitives", FigureForm::count},
                   {"light sources", FigureForm::count},
                   {"depth of the tree of rays", FigureForm::count}};
  for (const PaperScene& s : scenes) {
    const Result<LabScene> scene = lab.read(s.path, small_side, small_side);
    if (!scene) return scene.error();
    table.rows.push_back({s.name,
                          {counted(static_cast<double>(scene_figures(scene->scene).primitives)),
                           counted(static_cast<double>(scene->scene.lights.size())), counted(s.depth)}});
  }
  return success();
}

Status run_rr612_gain(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Traditional ray tracing against space tracing";
  table.about =
      "Pictures of 512 x 512 (IMA1, IMA2) and 256 x 256 (IMA3) at full effort; levels 4, 4 and 3, up to 2, 2 and 3 "
      "primitives a box, axes of the eye. Traditional is `none`: every ray meets every primitive.";
  table.columns = {{"boxes", FigureForm::count},
                   {"subdivision", FigureForm::seconds},
                   {"traditional", FigureForm::seconds},
                   {"space tracing", FigureForm::seconds},
                   {"gain factor", FigureForm::times},
                   {"tests a ray, traditional", FigureForm::number},
                   {"tests a ray, space tracing", FigureForm::number}};
  Ratios shares;
  lab.expect_steps(race_steps(lab, 2) * static_cast<int>(scenes.size()));
  for (const PaperScene& s : scenes) {
    const int side = lab.side(s.side);
    const Result<LabScene> scene = lab.read(s.path, side, side);
    if (!scene) return scene.error();
    const auto results = race_scene(lab, *scene, s.depth, {"none", space_tracing(s.level, s.primitives)});
    if (!results) return results.error();
    const RaceResult &none = (*results)[0], &space = (*results)[1];
    note_differences(*results, table);
    table.rows.push_back({s.name,
                          {counted(static_cast<double>(space.figures.boxes)), space.build_figure(),
                           none.render_figure(), space.render_figure(), speedup_figure(none, space),
                           counted(tests_a_ray(none)), counted(tests_a_ray(space))}});
    std::string id = s.name;
    std::transform(id.begin(), id.end(), id.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    table.claims.push_back(judge(paper.claim("gain-" + id), speedup(none, space)));
    shares.add({space.build.median() / space.render.median(), space.render.spread()});
  }
  table.claims.push_back(judge(paper.claim("preprocessing"), shares.largest()));
  return success();
}

Status run_rr612_statistics(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Statistics of space tracing";
  table.about =
      "Pictures of 256 x 256 at full effort; up to 2 primitives a box, axes of the eye. Secondary rays are those "
      "reflected and refracted.";
  table.columns = {{"boxes", FigureForm::count},
                   {"next box, primary", FigureForm::number},
                   {"next box, secondary", FigureForm::number},
                   {"next box, to lights", FigureForm::number},
                   {"mailbox", FigureForm::percent},
                   {"synthesis", FigureForm::seconds},
                   {"subdivision", FigureForm::seconds}};
  lab.expect_steps(race_steps(lab, 2) * static_cast<int>(scenes.size()));
  double mailboxes = 0;
  Ratios primary_calls, shadow_shares, level_ratios;
  for (const PaperScene& s : scenes) {
    const int side = lab.side(small_side);
    const Result<LabScene> scene = lab.read(s.path, side, side);
    if (!scene) return scene.error();
    const auto results = race_scene(lab, *scene, s.depth, {space_tracing(3, 2), space_tracing(4, 2)});
    if (!results) return results.error();
    note_differences(*results, table);
    for (std::size_t i = 0; i < 2; ++i) {
      const RaceResult& r = (*results)[i];
      const auto primary = next_box_calls_a_ray(r.statistics, {RayKind::primary});
      const auto secondary = next_box_calls_a_ray(r.statistics, {RayKind::reflected, RayKind::refracted});
      const auto shadow = next_box_calls_a_ray(r.statistics, {RayKind::shadow});
      const double mailbox = mailbox_share(r.statistics);
      table.rows.push_back({std::string(s.name) + ", level " + std::to_string(3 + i),
                            {counted(static_cast<double>(r.figures.boxes)),
                             {primary, 0, ""},
                             {secondary, 0, "-"},
                             {shadow, 0, ""},
                             counted(mailbox),
                             r.render_figure(),
                             r.build_figure()}});
      mailboxes += mailbox / static_cast<double>(2 * scenes.size());
      primary_calls.add({primary.value_or(0), 0});
      // IMA3 alone has transparent objects.
      if (s.depth > 1) shadow_shares.add({shadow.value_or(0) / primary.value_or(1), 0});
    }
    level_ratios.add(speedup((*results)[1], (*results)[0]));
  }
  table.claims = {
      judge(paper.claim("mailbox"), Measured{mailboxes, 0}), judge(paper.claim("few-boxes"), primary_calls.largest()),
      judge(paper.claim("shadow-boxes"), shadow_shares.least()), judge(paper.claim("level"), level_ratios.largest())};
  return success();
}

Status run_rr612_growth(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Influence of the number of primitives";
  table.about =
      "IMA2 with parts left out; pictures of 256 x 256 at full effort, level 4, up to 2 primitives a box, axes of "
      "the eye. Times are CPU time of the whole picture over all its rays.";
  table.columns = {{"traditional a ray", FigureForm::seconds},
                   {"space tracing a ray", FigureForm::seconds},
                   {"gain factor", FigureForm::times}};
  std::vector<Measured> traditional, gains;
  Ratios space_traced, gain_steps;
  LabSeries without{"traditional", {}, {}, false}, with{"space tracing", {}, {}, false};
  constexpr std::array<int, 5> sizes{72, 36, 24, 12, 8};
  lab.expect_steps(race_steps(lab, 2) * static_cast<int>(sizes.size()));
  for (const int primitives : sizes) {
    const int side = lab.side(small_side);
    const Result<LabScene> scene =
        lab.read("scenes/ima2.scad", side, side, {{"primitives", std::to_string(primitives)}});
    if (!scene) return scene.error();
    const auto results = race_scene(lab, *scene, 1, {"none", space_tracing(4, 2)});
    if (!results) return results.error();
    const RaceResult &none = (*results)[0], &space = (*results)[1];
    note_differences(*results, table);
    table.rows.push_back({std::to_string(primitives) + " primitives",
                          {none.per_ray_figure(), space.per_ray_figure(), speedup_figure(none, space)}});
    traditional.push_back({*none.per_ray_figure().value, none.render.spread()});
    const Measured space_time{*space.per_ray_figure().value, space.render.spread()};
    space_traced.add(space_time);
    gains.push_back(speedup(none, space));
    if (gains.size() > 1) {
      const Measured &more = gains[gains.size() - 2], &fewer = gains.back();
      gain_steps.add({more.value / fewer.value, more.spread + fewer.spread});
    }
    for (auto [series, value] : {std::pair(&without, traditional.back()), std::pair(&with, space_time)}) {
      series->x.push_back(primitives);
      series->y.push_back(value.value * 1e6);
    }
  }
  const Measured slowest = space_traced.largest(), fastest = space_traced.least();
  table.claims = {
      judge(paper.claim("constant"), Measured{slowest.value / fastest.value, slowest.spread + fastest.spread}),
      judge(paper.claim("grows"), Measured{traditional.front().value / traditional.back().value,
                                           traditional.front().spread + traditional.back().spread}),
      judge(paper.claim("gain-grows"), gain_steps.least())};
  table.plots = {
      {"rr612-4", "IMA2: mean time a ray", "primitives", "microseconds a ray", false, false, {without, with}}};
  return success();
}

Status run_rr612_memory(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Memory against levels, with and without sub-grids";
  table.about =
      "Boxes, projected trees and the spatial index. With sub-grids half of the levels belong to the first grid, "
      "the rest to the sub-grids of boxes that still hold more than 2 primitives. The paper proposes sub-grids "
      "and measures none.";
  table.columns = {{"one grid", FigureForm::bytes},
                   {"boxes", FigureForm::count},
                   {"sub-grids", FigureForm::bytes},
                   {"boxes with sub-grids", FigureForm::count},
                   {"sub-grids over one grid", FigureForm::times}};
  LabPlot plot{"rr612-memory", "Memory of space tracing", "levels of subdivision", "KiB", false, true, {}};
  Ratios deepest;
  for (const PaperScene& s : scenes) {
    const Result<LabScene> scene = lab.read(s.path, small_side, small_side);
    if (!scene) return scene.error();
    const ScreenView& view = scene->camera.view();
    LabSeries one{std::string(s.name) + ", one grid", {}, {}, false},
        two{std::string(s.name) + ", sub-grids", {}, {}, false};
    for (int levels = 2; levels <= 7; ++levels) {
      const std::string sub = "space-tracing-subgrids:levels=" + std::to_string(levels / 2) +
                              ",sublevels=" + std::to_string(levels - levels / 2) + ",axes=eye";
      const auto whole = build_accelerator(space_tracing(levels, 2), *scene->scene.tree, &view);
      if (!whole) return whole.error();
      const auto split = build_accelerator(sub, *scene->scene.tree, &view);
      if (!split) return split.error();
      const AcceleratorFigures a = (*whole)->figures(), b = (*split)->figures();
      const auto bytes = [](const AcceleratorFigures& f) { return static_cast<double>(f.memory_bytes); };
      table.rows.push_back({std::string(s.name) + ", level " + std::to_string(levels),
                            {counted(bytes(a)), counted(static_cast<double>(a.boxes)), counted(bytes(b)),
                             counted(static_cast<double>(b.boxes)), counted(bytes(b) / bytes(a))}});
      one.x.push_back(levels), one.y.push_back(bytes(a) / 1024);
      two.x.push_back(levels), two.y.push_back(bytes(b) / 1024);
      if (levels == 7) deepest.add({bytes(b) / bytes(a), 0});
    }
    plot.series.push_back(std::move(one));
    plot.series.push_back(std::move(two));
  }
  table.claims = {judge(paper.claim("subgrids"), deepest.largest())};
  table.plots = {std::move(plot)};
  return success();
}

}  // namespace tenon
