#include "lab/curves.h"

#include <algorithm>
#include <cstdio>

#include "lab/race.h"

namespace tenon {

namespace {

// Primitives from which on structures are not in memory together, where they might not fit.
constexpr std::size_t most_together = 20'000;

}  // namespace

Curves::Curves(Lab& lab, std::vector<std::string> structures, LabTable& table, LabPlot plot)
    : lab_(lab),
      structures_(std::move(structures)),
      table_(table),
      plot_(std::move(plot)),
      seconds_(structures_.size()) {
  for (const std::string& s : structures_) {
    table.columns.push_back({s, FigureForm::seconds});
    plot_.series.push_back({s, {}, {}, false});
  }
}

Status Curves::add(const std::string& row_name, double x, const LabScene& scene, int rounds) {
  std::vector<std::string> left;
  for (std::size_t i = 0; i < structures_.size(); ++i) {
    bool& cut_off = plot_.series[i].cut_off;
    cut_off = cut_off || expected_seconds(i) > lab_.effort().curve_seconds;
    if (!cut_off) left.push_back(structures_[i]);
  }
  RaceRules rules;
  rules.rounds = rounds;
  rules.together = scene_figures(scene.scene).primitives <= most_together;
  const auto results = race(lab_, structures_over(scene, left), rules, table_);
  if (!results) return results.error();
  LabRow row{row_name, std::vector<LabFigure>(size(), LabFigure{std::nullopt, 0, "over the limit"})};
  for (const RaceResult& r : *results) {
    const std::size_t i = index_of(r.name);
    row.figures[i] = timed(r.time_a_ray());
    plot_.series[i].x.push_back(x);
    plot_.series[i].y.push_back(r.time_a_ray().value * 1e6);
    seconds_[i].push_back(r.build.median() + r.render.median());
  }
  table_.rows.push_back(std::move(row));
  return success();
}

std::optional<Measured> Curves::at(std::size_t row, const std::string& structure) const {
  const LabFigure& figure = table_.rows[row].figures[index_of(structure)];
  if (!figure.value) return std::nullopt;
  return Measured{*figure.value, figure.spread};
}

// Of the next point, if it is to the last as that was to the one before.
double Curves::expected_seconds(std::size_t structure) const {
  const std::vector<double>& s = seconds_[structure];
  if (s.empty()) return 0;
  const double last = s.back(), before = s.size() > 1 ? s[s.size() - 2] : last;
  return last * std::max(1.0, last / before);
}

std::size_t Curves::index_of(const std::string& structure) const {
  return static_cast<std::size_t>(std::find(structures_.begin(), structures_.end(), structure) - structures_.begin());
}

std::string curve_limit_text(const Lab& lab) {
  char text[16];
  std::snprintf(text, sizeof text, "%g", lab.effort().curve_seconds);
  return "A curve ends, and is marked, before a point whose structure and picture would take more than " +
         std::string(text) + " s of CPU together, if it grew as between the two points before.";
}

}  // namespace tenon
