#include "lab/lab_json.h"

#include <array>

namespace tenon {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 6> form_names{"count", "number", "seconds", "bytes", "percent", "times"};
constexpr std::array<const char*, 3> verdict_names{"holds", "does not hold", "not comparable"};

Json optional_json(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json figure_json(const LabFigure& figure, const std::optional<double>& printed) {
  Json json{{"value", optional_json(figure.value)}};
  if (figure.spread > 0) json["spread"] = figure.spread;
  if (!figure.instead.empty()) json["instead"] = figure.instead;
  if (printed) json["paper"] = *printed;
  return json;
}

Json claim_json(const JudgedClaim& judged) {
  const Claim& claim = judged.claim;
  return {{"id", claim.id},
          {"text", claim.text},
          {"source", claim.source},
          {"ratio", claim.ratio},
          {"measured", optional_json(judged.measured)},
          {"spread", judged.spread},
          {"at_least", optional_json(claim.at_least)},
          {"at_most", optional_json(claim.at_most)},
          {"ratio_to_limit", optional_json(judged.ratio_to_limit)},
          {"verdict", verdict_names[static_cast<std::size_t>(judged.verdict)]}};
}

Json plot_json(const LabPlot& plot) {
  Json json{{"name", plot.name},
            {"title", plot.title},
            {"x_label", plot.x_label},
            {"y_label", plot.y_label},
            {"logarithmic_x", plot.logarithmic_x},
            {"logarithmic_y", plot.logarithmic_y},
            {"series", Json::array()}};
  for (const LabSeries& s : plot.series) {
    json["series"].push_back({{"name", s.name}, {"x", s.x}, {"y", s.y}, {"cut_off", s.cut_off}});
  }
  return json;
}

}  // namespace

Json lab_json(const LabTable& table, const Paper& paper, const LabOrigin& origin, const std::string& effort,
              double seconds) {
  const PaperTable* printed = paper.table(table.id);
  Json json{{"table", table.id},
            {"paper", paper.id},
            {"title", table.title},
            {"source", printed != nullptr ? printed->source : ""},
            {"about", table.about},
            {"origin",
             {{"machine", origin.machine},
              {"date", origin.date},
              {"compiler", origin.compiler},
              {"commit", origin.commit},
              {"load", origin.load},
              {"cores", origin.cores}}},
            {"effort", effort},
            {"seconds", seconds},
            {"largest_spread", table.largest_spread()},
            {"columns", Json::array()},
            {"rows", Json::array()},
            {"plots", Json::array()},
            {"pictures", Json::array()},
            {"claims", Json::array()},
            {"notes", table.notes}};
  for (const LabColumn& column : table.columns) {
    json["columns"].push_back({{"name", column.name}, {"form", form_names[static_cast<std::size_t>(column.form)]}});
  }
  for (const LabRow& row : table.rows) {
    Json figures = Json::array();
    for (std::size_t i = 0; i < row.figures.size(); ++i) {
      const auto value = printed != nullptr ? printed->figure(row.name, table.columns[i].name) : std::nullopt;
      figures.push_back(figure_json(row.figures[i], value));
    }
    json["rows"].push_back({{"name", row.name}, {"figures", figures}});
  }
  if (printed != nullptr) {
    for (const std::string& note : printed->notes) json["notes"].push_back(note);
  }
  for (const LabPlot& plot : table.plots) json["plots"].push_back(plot_json(plot));
  for (const LabPicture& p : table.pictures) json["pictures"].push_back({{"name", p.name}, {"title", p.title}});
  for (const JudgedClaim& claim : table.claims) json["claims"].push_back(claim_json(claim));
  return json;
}

}  // namespace tenon
