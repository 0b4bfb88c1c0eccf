#include <algorithm>
#include <array>
#include <cmath>

#include "lab/experiments.h"
#include "lab/race.h"
#include "lab/ratios.h"

namespace tenon {

namespace {

using Definitions = std::vector<std::pair<std::string, std::string>>;

constexpr int width = 128, height = 96;

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

std::vector<std::string> all_structures() {
  std::vector<std::string> names;
  for (const std::string_view name : accelerator_names()) names.emplace_back(name);
  return names;
}

/// A curve for each structure: a row for each scene of a series, a column for each structure.
class Curves {
 public:
  Curves(Lab& lab, std::vector<std::string> specs, LabTable& table, LabPlot plot)
      : lab_(lab), specs_(std::move(specs)), table_(table), plot_(std::move(plot)), cut_off_(specs_.size(), 0) {
    for (const std::string& spec : specs_) {
      table.columns.push_back({spec, FigureForm::seconds});
      plot_.series.push_back({spec, {}, {}, false});
    }
  }

  /// Measures all structures that have not met the time limit yet.
  /// @param x       of the points
  /// @param rounds  0: the lab's
  Status add(const std::string& row_name, double x, const LabScene& scene, int rounds = 0) {
    std::vector<Contender> contenders;
    for (std::size_t i = 0; i < specs_.size(); ++i) {
      if (!cut_off_[i]) contenders.push_back({specs_[i], &scene, specs_[i]});
    }
    LabRow row{row_name, std::vector<LabFigure>(specs_.size(), LabFigure{std::nullopt, 0, "over the limit"})};
    // Structures one after the other where they are large: all of them at once might not fit the memory.
    std::vector<RaceResult> results;
    const std::size_t together = scene_figures(scene.scene).primitives > most_together ? 1 : contenders.size();
    for (std::size_t begin = 0; begin < contenders.size(); begin += together) {
      const std::size_t end = std::min(begin + together, contenders.size());
      auto part = race(lab_,
                       {contenders.begin() + static_cast<std::ptrdiff_t>(begin),
                        contenders.begin() + static_cast<std::ptrdiff_t>(end)},
                       RenderOptions{}, rounds);
      if (!part) return part.error();
      std::move(part->begin(), part->end(), std::back_inserter(results));
    }
    note_differences(results, table_);
    for (const RaceResult& r : results) {
      const std::size_t i = index_of(r.name);
      row.figures[i] = r.per_ray_figure();
      plot_.series[i].x.push_back(x);
      plot_.series[i].y.push_back(*row.figures[i].value * 1e6);
      if (r.build.median() + r.render.median() > lab_.effort().curve_seconds) {
        cut_off_[i] = 1;
        plot_.series[i].cut_off = true;
      }
    }
    table_.rows.push_back(std::move(row));
    return success();
  }

  /// A figure measured before, with its spread.
  std::optional<Measured> at(std::size_t row, const std::string& spec) const {
    const LabFigure& figure = table_.rows[row].figures[index_of(spec)];
    if (!figure.value) return std::nullopt;
    return Measured{*figure.value, figure.spread};
  }

  std::size_t size() const { return specs_.size(); }
  void finish() { table_.plots.push_back(std::move(plot_)); }

 private:
  static constexpr std::size_t most_together = 20'000;

  std::size_t index_of(const std::string& spec) const {
    return static_cast<std::size_t>(std::find(specs_.begin(), specs_.end(), spec) - specs_.begin());
  }

  Lab& lab_;
  std::vector<std::string> specs_;
  LabTable& table_;
  LabPlot plot_;
  std::vector<char> cut_off_;
};

std::optional<Measured> divided(const std::optional<Measured>& a, const std::optional<Measured>& b) {
  if (!a || !b) return std::nullopt;
  return Measured{a->value / b->value, a->spread + b->spread};
}

}  // namespace

Status run_scaling_size(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "From 10 to a million primitives";
  table.about =
      "A box less n balls that together take away the same volume whatever n is (`scenes/bench/spheres.scad`); time "
      "a ray of pictures of 128 x 96 at full effort, shadow rays included, building not. A point whose structure "
      "and picture take more than 4 s of CPU together (full effort) is the last of its curve.";
  Curves curves(lab, all_structures(), table,
                {"scaling-size", "A box less n balls", "balls", "microseconds a ray", true, true, {}});
  std::vector<double> sizes;
  for (double n = 10; n <= lab.effort().most_spheres; n *= 10) sizes.push_back(n);
  lab.expect_steps(static_cast<int>(sizes.size() * curves.size()) * 2);
  for (const double n : sizes) {
    const Result<LabScene> scene = lab.read("scenes/bench/spheres.scad", lab.side(width), lab.side(height),
                                            {{"n", std::to_string(static_cast<long>(n))}});
    if (!scene) return scene.error();
    if (Status status = curves.add(std::to_string(static_cast<long>(n)), n, *scene, 1); !status) return status;
  }
  std::optional<Measured> last;
  for (std::size_t row = 1; row < sizes.size(); ++row) {
    if (const auto figure = curves.at(row, "space-tracing")) last = figure;
  }
  table.claims = {judge(paper.claim("constant"), divided(last, curves.at(0, "space-tracing")))};
  curves.finish();
  return success();
}

Status run_scaling_stadium(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "A teapot in a stadium";
  table.about =
      "Newell's teapot of some 900 triangles on a ground of its size, and on the lawn of a stadium of 2,400 seats "
      "(`lab/scenes/stadium.scad`); the same picture but for the seats, and one from the stand.";
  const std::vector<std::string> specs = [] {
    std::vector<std::string> names = all_structures();
    names.erase(std::find(names.begin(), names.end(), "none"));
    return names;
  }();
  table.columns = {{"alone", FigureForm::seconds},
                   {"in the stadium", FigureForm::seconds},
                   {"from the stand", FigureForm::seconds},
                   {"slowdown", FigureForm::times}};
  const std::array<Definitions, 3> variants{
      {{{"seats", "false"}}, {{"seats", "true"}}, {{"seats", "true"}, {"wide", "true"}}}};
  lab.expect_steps(race_steps(lab, specs.size()) * 3);
  for (const std::string& spec : specs) table.rows.push_back({spec, {}});
  for (const Definitions& definitions : variants) {
    const Result<LabScene> scene = lab.read("lab/scenes/stadium.scad", lab.side(width), lab.side(height), definitions);
    if (!scene) return scene.error();
    std::vector<Contender> contenders;
    for (const std::string& spec : specs) contenders.push_back({spec, &*scene, spec});
    const auto results = race(lab, contenders, RenderOptions{});
    if (!results) return results.error();
    note_differences(*results, table);
    for (std::size_t i = 0; i < results->size(); ++i) table.rows[i].figures.push_back((*results)[i].per_ray_figure());
  }
  std::optional<Measured> grid, space;
  for (LabRow& row : table.rows) {
    const LabFigure &alone = row.figures[0], &inside = row.figures[1];
    const Measured slowdown{*inside.value / *alone.value, alone.spread + inside.spread};
    row.figures.push_back({slowdown.value, slowdown.spread, ""});
    if (row.name == "grid") grid = slowdown;
    if (row.name == "space-tracing") space = slowdown;
  }
  table.claims = {judge(paper.claim("stadium"), divided(grid, space))};
  return success();
}

Status run_scaling_overlap(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Primitives that overlap";
  table.about =
      "343 balls in a lattice that overlap by a share of their diameter, from touching to all in one place "
      "(`lab/scenes/overlap.scad`); time a ray.";
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
    const Result<LabScene> scene = lab.read("lab/scenes/overlap.scad", lab.side(width), lab.side(height),
                                            {{"overlap", std::to_string(percent / 100.0)}});
    if (!scene) return scene.error();
    if (Status status = curves.add(std::to_string(percent) + " %", percent, *scene); !status) return status;
  }
  const std::size_t ninety = 5;
  table.claims = {judge(paper.claim("overlap"), divided(divided(curves.at(ninety, "okd"), curves.at(ninety, "nbvh")),
                                                        divided(curves.at(0, "okd"), curves.at(0, "nbvh"))))};
  curves.finish();
  return success();
}

Status run_scaling_balance(Lab& lab, const Paper& paper, LabTable& table) {
  table.title = "Balanced and lopsided trees of the same solid";
  table.about =
      "A union of n balls as a balanced tree, and as one ball and all the rest (`lab/scenes/trees.scad`); time a ray.";
  Curves curves(lab, {"none", "nbvh", "okd", "multi-kd", "median-bvh", "cells"}, table,
                {"scaling-balance", "", "", "", false, false, {}});
  constexpr std::array<int, 2> sizes{64, 512};
  constexpr std::array<const char*, 2> shapes{"balanced", "lopsided"};
  lab.expect_steps(race_steps(lab, curves.size()) * static_cast<int>(sizes.size() * shapes.size()));
  for (const int n : sizes) {
    for (const char* shape : shapes) {
      const Result<LabScene> scene = lab.read("lab/scenes/trees.scad", lab.side(width), lab.side(height),
                                              {{"n", std::to_string(n)}, {"shape", quoted(shape)}});
      if (!scene) return scene.error();
      if (Status status = curves.add(std::to_string(n) + " balls, " + shape, n, *scene); !status) return status;
    }
  }
  const std::size_t balanced = 2, lopsided = 3;
  table.claims = {
      judge(paper.claim("lopsided"), divided(divided(curves.at(lopsided, "nbvh"), curves.at(balanced, "nbvh")),
                                             divided(curves.at(lopsided, "okd"), curves.at(balanced, "okd"))))};
  return success();
}

Status run_scaling_depth(Lab& lab, const Paper&, LabTable& table) {
  table.title = "Chains of unions, differences and intersections";
  table.about = "Each operation's second operand is the whole rest of the chain (`lab/scenes/trees.scad`); time a ray.";
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
          lab.read("lab/scenes/trees.scad", lab.side(width), lab.side(height),
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
