#include <array>

#include "lab/experiments.h"
#include "lab/race.h"
#include "lab/ratios.h"

namespace tenon {

namespace {

/// A scene of the paper, as its tables 1 and 2 use it.
struct PaperScene {
  const char* name;
  const char* claim;  ///< about its gain factor
  const char* path;
  int side;   ///< of the picture of table 2
  int depth;  ///< of the tree of rays
  int level, primitives;
};
constexpr std::array<PaperScene, 3> scenes{{{"IMA1", "gain-ima1", "scenes/ima1.scad", 512, 1, 4, 2},
                                            {"IMA2", "gain-ima2", "scenes/ima2.scad", 512, 1, 4, 2},
                                            {"IMA3", "gain-ima3", "scenes/ima3.scad", 256, 5, 3, 3}}};
// Of tables 3 and 4.
constexpr int small_side = 256;
// Where the paper prints no figures.
constexpr int levels_side = 128;
// What is left of IMA2 in table 4.
constexpr std::array<int, 5> ima2_sizes{72, 36, 24, 12, 8};

Definitions ima2_of(int primitives) {
  return {{"primitives", std::to_string(primitives)}};
}

std::string space_tracing(int level, int primitives) {
  return "space-tracing:levels=" + std::to_string(level) + ",primitives=" + std::to_string(primitives) + ",axes=eye";
}

RaceRules rules_of(int depth) {
  RaceRules rules;
  rules.options.depth = depth;
  return rules;
}

/// A scene whose statistics are taken.
struct StatisticsScene {
  std::string name, path;
  int depth;
  Definitions definitions;
  bool in_paper;  ///< in table 3, of which the claims speak
};

std::vector<StatisticsScene> statistics_scenes() {
  std::vector<StatisticsScene> all;
  for (const PaperScene& s : scenes) all.push_back({s.name, s.path, s.depth, {}, true});
  for (std::size_t i = 1; i < ima2_sizes.size(); ++i) {
    all.push_back({"IMA2 with " + std::to_string(ima2_sizes[i]) + " primitives", scenes[1].path, scenes[1].depth,
                   ima2_of(ima2_sizes[i]), false});
  }
  return all;
}

/// What the claims about table 3 are judged by.
struct SpaceTracingStatistics {
  Ratios primary_calls, secondary_calls, shadow_over_primary;
  double mailboxes = 0;

  void add(const RaceResult& r, bool has_transparent_objects) {
    const double primary = next_box_calls_a_ray(r.statistics, {RayKind::primary}).value_or(0);
    const auto secondary = next_box_calls_a_ray(r.statistics, {RayKind::reflected, RayKind::refracted});
    const double shadow = next_box_calls_a_ray(r.statistics, {RayKind::shadow}).value_or(0);
    primary_calls.add({primary, 0});
    if (secondary) secondary_calls.add({*secondary, 0});
    if (has_transparent_objects) shadow_over_primary.add({shadow / primary, 0});
    mailboxes += mailbox_share(r.statistics) / static_cast<double>(2 * scenes.size());
  }
};

LabRow statistics_row(const std::string& name, const RaceResult& r, const RaceResult& traditional) {
  return {name,
          {counted(r.boxes()),
           {next_box_calls_a_ray(r.statistics, {RayKind::primary}), 0, ""},
           {next_box_calls_a_ray(r.statistics, {RayKind::reflected, RayKind::refracted}), 0, "-"},
           {next_box_calls_a_ray(r.statistics, {RayKind::shadow}), 0, ""},
           counted(mailbox_share(r.statistics)),
           timed(r.render_time()),
           timed(r.build_time()),
           timed(speedup(traditional, r))}};
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
  table.about = "Pictures of " + lab.pixels(scenes[0].side, scenes[0].side) + " (IMA1, IMA2) and " +
                lab.pixels(scenes[2].side, scenes[2].side) +
                " (IMA3); levels 4, 4 and 3, up to 2, 2 and 3 primitives a box, axes of the eye. Traditional is "
                "`none`: every ray meets every primitive.";
  table.columns = {{"boxes", FigureForm::count},
                   {"subdivision", FigureForm::seconds},
                   {"traditional", FigureForm::seconds},
                   {"space tracing", FigureForm::seconds},
                   {"gain factor", FigureForm::times},
                   {"tests a ray, traditional", FigureForm::number},
                   {"tests a ray, space tracing", FigureForm::number}};
  Ratios shares, tests;
  lab.expect_steps(race_steps(lab, 2) * static_cast<int>(scenes.size()));
  for (const PaperScene& s : scenes) {
    const Result<LabScene> scene = lab.read(s.path, s.side, s.side);
    if (!scene) return scene.error();
    const auto results =
        race(lab, structures_over(*scene, {"none", space_tracing(s.level, s.primitives)}), rules_of(s.depth), table);
    if (!results) return results.error();
    const RaceResult &none = (*results)[0], &space = (*results)[1];
    table.rows.push_back(
        {s.name,
         {counted(space.boxes()), timed(space.build_time()), timed(none.render_time()), timed(space.render_time()),
          timed(speedup(none, space)), counted(none.tests_a_ray()), counted(space.tests_a_ray())}});
    table.claims.push_back(judge(paper.claim(s.claim), speedup(none, space)));
    shares.add(divided(space.build_time(), space.render_time()));
    tests.add({none.tests_a_ray() / space.tests_a_ray(), 0});
  }
  table.claims.push_back(judge(paper.claim("fewer-intersections"), tests.least()));
  table.claims.push_back(judge(paper.claim("preprocessing"), shares.largest()));
  return success();
}

Status run_rr612_statistics(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Statistics of space tracing";
  table.about = "Pictures of " + lab.pixels(small_side, small_side) +
                "; up to 2 primitives a box, axes of the eye. Secondary rays are those reflected and refracted. The "
                "gain factor is over `none`, and the rows of IMA2 with fewer primitives are not in the paper's table.";
  table.columns = {{"boxes", FigureForm::count},
                   {"next box, primary", FigureForm::number},
                   {"next box, secondary", FigureForm::number},
                   {"next box, to lights", FigureForm::number},
                   {"mailbox", FigureForm::percent},
                   {"synthesis", FigureForm::seconds},
                   {"subdivision", FigureForm::seconds},
                   {"gain factor", FigureForm::times}};
  const std::vector<StatisticsScene> all = statistics_scenes();
  lab.expect_steps(race_steps(lab, 3) * static_cast<int>(all.size()));
  SpaceTracingStatistics found;
  for (const StatisticsScene& s : all) {
    const Result<LabScene> scene = lab.read(s.path, small_side, small_side, s.definitions);
    if (!scene) return scene.error();
    const auto results = race(lab, structures_over(*scene, {"none", space_tracing(3, 2), space_tracing(4, 2)}),
                              rules_of(s.depth), table);
    if (!results) return results.error();
    const RaceResult &none = (*results)[0], &third = (*results)[1], &fourth = (*results)[2];
    table.rows.push_back(statistics_row(s.name + ", level 3", third, none));
    table.rows.push_back(statistics_row(s.name + ", level 4", fourth, none));
    if (!s.in_paper) continue;
    // IMA3 alone has transparent objects, and rays deeper than 1.
    for (const RaceResult* r : {&third, &fourth}) found.add(*r, s.depth > 1);
  }
  table.claims = {judge(paper.claim("mailbox"), Measured{found.mailboxes, 0}),
                  judge(paper.claim("few-boxes"), found.primary_calls.largest()),
                  judge(paper.claim("few-boxes-secondary"), found.secondary_calls.largest()),
                  judge(paper.claim("shadow-boxes"), found.shadow_over_primary.least())};
  return success();
}

Status run_rr612_growth(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Influence of the number of primitives";
  table.about = "IMA2 with parts left out; pictures of " + lab.pixels(small_side, small_side) +
                ", level 4, up to 2 primitives a box, axes of the eye. Times are CPU time of the whole picture over "
                "all its rays.";
  table.columns = {{"traditional a ray", FigureForm::seconds},
                   {"space tracing a ray", FigureForm::seconds},
                   {"gain factor", FigureForm::times}};
  std::vector<Measured> traditional, space_traced, gains;
  LabSeries without{"traditional", {}, {}, false}, with{"space tracing", {}, {}, false};
  lab.expect_steps(race_steps(lab, 2) * static_cast<int>(ima2_sizes.size()));
  for (const int primitives : ima2_sizes) {
    const Result<LabScene> scene = lab.read(scenes[1].path, small_side, small_side, ima2_of(primitives));
    if (!scene) return scene.error();
    const auto results = race(lab, structures_over(*scene, {"none", space_tracing(4, 2)}), rules_of(1), table);
    if (!results) return results.error();
    const RaceResult &none = (*results)[0], &space = (*results)[1];
    traditional.push_back(none.time_a_ray());
    space_traced.push_back(space.time_a_ray());
    gains.push_back(speedup(none, space));
    table.rows.push_back({std::to_string(primitives) + " primitives",
                          {timed(traditional.back()), timed(space_traced.back()), timed(gains.back())}});
    without.x.push_back(primitives), without.y.push_back(traditional.back().value * 1e6);
    with.x.push_back(primitives), with.y.push_back(space_traced.back().value * 1e6);
  }
  Ratios times, gain_steps;
  for (const Measured& m : space_traced) times.add(m);
  for (std::size_t i = 1; i < gains.size(); ++i) gain_steps.add(divided(gains[i - 1], gains[i]));
  table.claims = {judge(paper.claim("constant"), divided(times.largest(), times.least())),
                  judge(paper.claim("grows"), divided(traditional.front(), traditional.back())),
                  judge(paper.claim("gain-grows"), gain_steps.least())};
  table.plots = {
      {"rr612-4", "IMA2: mean time a ray", "primitives", "microseconds a ray", false, false, {without, with}}};
  return success();
}

Status run_rr612_levels(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Memory and time against levels, with and without sub-grids";
  table.about = "Memory is that of boxes, projected trees and the spatial index; pictures of " +
                lab.pixels(levels_side, levels_side) +
                ". With sub-grids half of the levels belong to the first grid, the rest to the sub-grids of boxes that "
                "still hold "
                "more than 2 primitives. The paper proposes sub-grids and measures none.";
  table.columns = {{"one grid", FigureForm::bytes},
                   {"boxes", FigureForm::count},
                   {"synthesis", FigureForm::seconds},
                   {"sub-grids", FigureForm::bytes},
                   {"boxes with sub-grids", FigureForm::count},
                   {"synthesis with sub-grids", FigureForm::seconds},
                   {"sub-grids over one grid", FigureForm::times}};
  LabPlot memory{"rr612-memory", "Memory of space tracing", "levels of subdivision", "KiB", false, true, {}};
  LabPlot times{
      "rr612-levels", "Time of space tracing", "levels of subdivision", "microseconds a ray", false, false, {}};
  constexpr int first_level = 2, last_level = 7;
  std::vector<std::string> structures;
  for (int levels = first_level; levels <= last_level; ++levels) {
    structures.push_back(space_tracing(levels, 2));
    structures.push_back("space-tracing-subgrids:levels=" + std::to_string(levels / 2) +
                         ",sublevels=" + std::to_string(levels - levels / 2) + ",axes=eye");
  }
  lab.expect_steps(race_steps(lab, structures.size()) * static_cast<int>(scenes.size()));
  Ratios deepest, steps;
  for (const PaperScene& s : scenes) {
    const Result<LabScene> scene = lab.read(s.path, levels_side, levels_side);
    if (!scene) return scene.error();
    const auto results = race(lab, structures_over(*scene, structures), rules_of(s.depth), table);
    if (!results) return results.error();
    const std::string name = s.name;
    LabSeries one{name + ", one grid", {}, {}, false}, two{name + ", sub-grids", {}, {}, false};
    LabSeries one_time = one, two_time = two;
    for (int levels = first_level; levels <= last_level; ++levels) {
      const auto at = 2 * static_cast<std::size_t>(levels - first_level);
      const RaceResult &whole = (*results)[at], &split = (*results)[at + 1];
      const double share = split.memory_bytes() / whole.memory_bytes();
      table.rows.push_back(
          {name + ", level " + std::to_string(levels),
           {counted(whole.memory_bytes()), counted(whole.boxes()), timed(whole.render_time()),
            counted(split.memory_bytes()), counted(split.boxes()), timed(split.render_time()), counted(share)}});
      one.x.push_back(levels), one.y.push_back(whole.memory_bytes() / 1024);
      two.x.push_back(levels), two.y.push_back(split.memory_bytes() / 1024);
      one_time.x.push_back(levels), one_time.y.push_back(whole.time_a_ray().value * 1e6);
      two_time.x.push_back(levels), two_time.y.push_back(split.time_a_ray().value * 1e6);
      if (levels == last_level) deepest.add({share, 0});
      if (levels > first_level) steps.add(speedup(whole, (*results)[at - 2]));
    }
    memory.series.push_back(std::move(one)), memory.series.push_back(std::move(two));
    times.series.push_back(std::move(one_time)), times.series.push_back(std::move(two_time));
  }
  table.claims = {judge(paper.claim("level"), steps.largest()), judge(paper.claim("subgrids"), deepest.largest())};
  table.plots = {std::move(memory), std::move(times)};
  return success();
}

}  // namespace tenon
