#include "lab/paper.h"

#include <algorithm>
#include <cassert>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace tenon {

namespace {

using Json = nlohmann::json;

std::optional<double> optional_number(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

PaperTable read_table(const std::string& id, const Json& json) {
  PaperTable table{id, json.at("source"), json.at("columns"), json.at("rows"), {}, {}};
  for (const Json& row : json.at("figures")) {
    table.figures.emplace_back();
    for (const Json& figure : row) table.figures.back().push_back(optional_number(figure));
    if (row.size() != table.columns.size()) throw std::runtime_error(id + " has a row of another length");
  }
  if (table.figures.size() != table.rows.size()) throw std::runtime_error(id + " has not a row for each name");
  if (json.contains("notes")) table.notes = json["notes"].get<std::vector<std::string>>();
  return table;
}

Claim read_claim(const Json& json) {
  Claim claim{json.at("id"), json.at("text"), json.at("source"), json.at("ratio"), {}, {}, "", "", ""};
  claim.at_least = optional_number(json.value("at_least", Json()));
  claim.at_most = optional_number(json.value("at_most", Json()));
  if (!claim.at_least && !claim.at_most) throw std::runtime_error("the claim " + claim.id + " has no limit");
  for (const auto& limit : {claim.at_least, claim.at_most}) {
    if (limit && !(*limit > 0)) throw std::runtime_error("the claim " + claim.id + " has a limit that is not over 0");
  }
  claim.why_it_holds = json.value("why_it_holds", "");
  claim.why_it_fails = json.value("why_it_fails", "");
  claim.why_undecided = json.value("why_undecided", "");
  return claim;
}

}  // namespace

std::optional<double> PaperTable::figure(const std::string& row, const std::string& column) const {
  const auto r = std::find(rows.begin(), rows.end(), row);
  const auto c = std::find(columns.begin(), columns.end(), column);
  if (r == rows.end() || c == columns.end()) return std::nullopt;
  return figures[static_cast<std::size_t>(r - rows.begin())][static_cast<std::size_t>(c - columns.begin())];
}

const PaperTable* Paper::table(const std::string& wanted) const {
  const auto found = std::find_if(tables.begin(), tables.end(), [&](const PaperTable& t) { return t.id == wanted; });
  return found == tables.end() ? nullptr : &*found;
}

const Claim& Paper::claim(const std::string& wanted) const {
  const auto found = std::find_if(claims.begin(), claims.end(), [&](const Claim& c) { return c.id == wanted; });
  assert(found != claims.end());
  return *found;
}

Result<Paper> read_paper(const std::string& folder, const std::string& id) {
  const std::string path = folder + "/" + id + ".json";
  std::ifstream file(path);
  if (!file) {
    return Error{ErrorKind::input,
                 "there is no '" + path + "'; run 'tenon lab' from the repository's root, or name it with --root",
                 {}};
  }
  try {
    const Json json = Json::parse(file);
    Paper paper{id, json.at("title"), json.at("reference"), json.at("summary"), {}, {}};
    for (const auto& [name, table] : json.at("tables").items()) paper.tables.push_back(read_table(name, table));
    for (const Json& claim : json.at("claims")) paper.claims.push_back(read_claim(claim));
    return paper;
  } catch (const std::exception& error) {
    return Error{ErrorKind::input, path + ": " + error.what(), {}};
  }
}

}  // namespace tenon
