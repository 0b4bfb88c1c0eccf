#include <algorithm>
#include <array>

#include "lab/curves.h"
#include "lab/experiments.h"
#include "lab/race.h"

namespace tenon {

namespace {

constexpr int width = 128, height = 96;

std::vector<std::string> all_structures() {
  std::vector<std::string> names;
  for (const std::string_view name : accelerator_names()) names.emplace_back(name);
  return names;
}

}  // namespace

Status run_scaling_size(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "From 10 to a million primitives";
  table.about =
      "A box less n balls that together take away the same volume whatever n is (`scenes/bench/spheres.scad`); time a "
      "ray of pictures of " +
      lab.pixels(width, height) +
      ", shadow rays included, building not; of more than 1,000 balls once, of fewer in rounds. " +
      curve_limit_text(lab);
  Curves curves(lab, all_structures(), table,
                {"scaling-size", "A box less n balls", "balls", "microseconds a ray", true, true, {}});
  std::vector<double> sizes;
  for (double n = 10; n <= lab.effort().most_spheres; n *= 10) sizes.push_back(n);
  // Larger scenes take long, and times that are long are disturbed by little.
  const auto rounds_for = [](double n) { return n > 1000 ? 1 : 0; };
  int steps = 0;
  for (const double n : sizes) steps += race_steps(lab, curves.size(), rounds_for(n));
  lab.expect_steps(steps);
  for (const double n : sizes) {
    const Result<LabScene> scene =
        lab.read("scenes/bench/spheres.scad", width, height, {{"n", std::to_string(static_cast<long>(n))}});
    if (!scene) return scene.error();
    const Status status = curves.add(std::to_string(static_cast<long>(n)), n, *scene, rounds_for(n));
    if (!status) return status;
  }
  std::optional<Measured> last;
  for (std::size_t row = 1; row < sizes.size(); ++row) {
    if (const auto figure = curves.at(row, "space-tracing")) last = figure;
  }
  const std::size_t ten = 0, thousand = 2;
  const auto gain = sizes.size() > thousand ? divided(curves.at(thousand, "none"), curves.at(thousand, "space-tracing"))
                                            : std::nullopt;
  table.claims = {judge(paper.claim("constant"), divided(last, curves.at(ten, "space-tracing"))),
                  judge(paper.claim("hundreds"), gain)};
  curves.finish();
  return success();
}

Status run_scaling_stadium(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "A teapot in a stadium";
  table.about =
      "Newell's teapot of some 900 triangles on a ground of its size, and on the lawn of a stadium of 2,400 seats "
      "(`lab/scenes/stadium.scad`); the same picture but for the seats, and one from the stand.";
  const std::string deep_space_tracing = "space-tracing-subgrids:levels=6,sublevels=6";
  const std::vector<std::string> specs = [&] {
    std::vector<std::string> names = all_structures();
    names.erase(std::find(names.begin(), names.end(), "none"));
    // Those that halve space, with as many levels as the scene asks for.
    names.insert(names.end(), {deep_space_tracing, "bsp:depth=40"});
    return names;
  }();
  table.columns = {{"alone", FigureForm::seconds},
                   {"in the stadium", FigureForm::seconds},
                   {"from the stand", FigureForm::seconds},
                   {"slowdown", FigureForm::times}};
  const std::array<Definitions, 3> variants{
      {{{"seats", "false"}}, {{"seats", "true"}}, {{"seats", "true"}, {"wide", "true"}}}};
  lab.expect_steps(race_steps(lab, specs.size()) * 3);
  std::vector<std::vector<Measured>> times(specs.size());
  for (const Definitions& definitions : variants) {
    const Result<LabScene> scene = lab.read("lab/scenes/stadium.scad", width, height, definitions);
    if (!scene) return scene.error();
    const auto results = race(lab, structures_over(*scene, specs), {}, table);
    if (!results) return results.error();
    for (std::size_t i = 0; i < results->size(); ++i) times[i].push_back((*results)[i].time_a_ray());
  }
  std::optional<Measured> grid, space;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const Measured &alone = times[i][0], &inside = times[i][1], &wide = times[i][2];
    const Measured slowdown = divided(inside, alone);
    table.rows.push_back({specs[i], {timed(alone), timed(inside), timed(wide), timed(slowdown)}});
    if (specs[i] == "grid") grid = slowdown;
    if (specs[i] == deep_space_tracing) space = slowdown;
  }
  table.claims = {judge(paper.claim("stadium"), divided(grid, space))};
  return success();
}

Status run_scaling_overlap(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Primitives that overlap";
  table.about =
      "343 balls in a lattice that overlap by a share of their diameter, from touching to all in one place "
      "(`lab/scenes/overlap.scad`); time a ray. " +
      curve_limit_text(lab);
  Curves curves(lab, all_structures(), table,
                {"scaling-overlap",
                 "343 balls that overlap",
                 "overlap, % of the diameter",
                 "microseconds a ray",
                 false,
                 true,
                 {}});
  constexpr std::array<int, 7> percents{0, 20, 40, 60, 80, 90, 100};
  lab.expect_steps(race_steps(lab, curves.size()) * static_cast<int>(percents.size()));
  for (const int percent : percents) {
    const Result<LabScene> scene =
        lab.read("lab/scenes/overlap.scad", width, height, {{"overlap", std::to_string(percent / 100.0)}});
    if (!scene) return scene.error();
    if (Status status = curves.add(std::to_string(percent) + " %", percent, *scene); !status) return status;
  }
  const std::size_t ninety = 5;
  table.claims = {judge(paper.claim("overlap"), divided(divided(curves.at(ninety, "okd"), curves.at(ninety, "nbvh")),
                                                        divided(curves.at(0, "okd"), curves.at(0, "nbvh")))),
                  judge(paper.claim("little-overlap"), divided(curves.at(0, "nbvh"), curves.at(0, "okd")))};
  curves.finish();
  return success();
}

Status run_scaling_balance(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Balanced and lopsided trees of the same solid";
  table.about =
      "A union of n balls as a balanced tree, and as one ball and all the rest (`lab/scenes/trees.scad`); time a ray.";
  Curves curves(lab, {"none", "nbvh", "okd", "multi-kd", "median-bvh", "cells"}, table, {});
  constexpr std::array<int, 2> sizes{64, 512};
  constexpr std::array<const char*, 2> shapes{"balanced", "lopsided"};
  lab.expect_steps(race_steps(lab, curves.size()) * static_cast<int>(sizes.size() * shapes.size()));
  for (const int n : sizes) {
    for (const char* shape : shapes) {
      const Result<LabScene> scene =
          lab.read("lab/scenes/trees.scad", width, height, {{"n", std::to_string(n)}, {"shape", quoted(shape)}});
      if (!scene) return scene.error();
      if (Status status = curves.add(std::to_string(n) + " balls, " + shape, n, *scene); !status) return status;
    }
  }
  const std::size_t balanced = 2, lopsided = 3;
  table.claims = {
      judge(paper.claim("lopsided"), divided(divided(curves.at(lopsided, "nbvh"), curves.at(balanced, "nbvh")),
                                             divided(curves.at(lopsided, "okd"), curves.at(balanced, "okd")))),
      judge(paper.claim("unbalanced"), divided(curves.at(lopsided, "nbvh"), curves.at(lopsided, "okd")))};
  return success();
}

Status run_scaling_depth(Lab& lab, const Paper&, LabTable& table) {
  table.title = "Chains of unions, differences and intersections";
  table.about =
      "Each operation's second operand is the whole rest of the chain (`lab/scenes/trees.scad`); time a ray. " +
      curve_limit_text(lab);
  const std::vector<std::string> specs{"none", "nbvh", "space-tracing", "okd", "multi-kd", "cells"};
  for (const std::string& spec : specs) table.columns.push_back({spec, FigureForm::seconds});
  constexpr std::array<int, 5> depths{2, 8, 32, 128, 512};
  constexpr std::array<const char*, 3> operations{"union", "difference", "intersection"};
  lab.expect_steps(race_steps(lab, specs.size()) * static_cast<int>(depths.size() * operations.size()));
  for (const char* operation : operations) {
    LabTable part;
    Curves curves(lab, specs, part,
                  {"scaling-depth-" + std::string(operation),
                   "Chains of " + std::string(operation) + "s",
                   "operands",
                   "microseconds a ray",
                   true,
                   true,
                   {}});
    for (const int depth : depths) {
      const Result<LabScene> scene =
          lab.read("lab/scenes/trees.scad", width, height,
                   {{"n", std::to_string(depth)}, {"shape", quoted("chain")}, {"operation", quoted(operation)}});
      if (!scene) return scene.error();
      const Status status = curves.add(std::to_string(depth) + " operands, " + operation, depth, *scene);
      if (!status) return status;
    }
    curves.finish();
    std::move(part.rows.begin(), part.rows.end(), std::back_inserter(table.rows));
    std::move(part.plots.begin(), part.plots.end(), std::back_inserter(table.plots));
    std::move(part.notes.begin(), part.notes.end(), std::back_inserter(table.notes));
  }
  return success();
}

}  // namespace tenon
