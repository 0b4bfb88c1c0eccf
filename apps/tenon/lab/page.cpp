#include "lab/page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace tenon {

namespace {

using Json = nlohmann::ordered_json;

// A table whose figures differ by more than this between rounds says so.
constexpr double noisy_spread = 0.1;

std::string print(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Three digits, without an exponent where it is readable without.
std::string three_digits(double value) {
  const double size = std::fabs(value);
  if (size == 0) return "0";
  if (size >= 1e6 || size < 1e-3) return print("%.2e", value);
  const int decimals = size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3;
  char text[48];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string spread_text(double spread) {
  return print(spread < 0.01 ? " ±%.1f %%" : " ±%.0f %%", 100 * spread);
}

std::string seconds_text(double s) {
  if (s >= 3600) return print("%.1f h", s / 3600);
  if (s >= 600) return print("%.1f min", s / 60);
  if (s >= 1) return three_digits(s) + " s";
  if (s >= 1e-3) return three_digits(s * 1e3) + " ms";
  if (s >= 1e-6) return three_digits(s * 1e6) + " µs";
  return s == 0 ? "0 s" : three_digits(s * 1e9) + " ns";
}

std::string bytes_text(double bytes) {
  return bytes >= 0x1p20 ? three_digits(bytes / 0x1p20) + " MiB" : three_digits(bytes / 1024) + " KiB";
}

bool has_paper(const Json& table, std::size_t column) {
  for (const Json& row : table["rows"]) {
    if (row["figures"][column].contains("paper")) return true;
  }
  return false;
}

std::string measured_text(const Json& figure, const std::string& form) {
  if (figure["value"].is_null()) return figure.value("instead", "");
  std::string text = figure_text(figure["value"].get<double>(), form);
  if (figure.contains("spread")) text += spread_text(figure["spread"].get<double>());
  return text;
}

std::string origin_line(const Json& table) {
  const Json& origin = table["origin"];
  return "*" + origin["machine"].get<std::string>() + "; " + origin["date"].get<std::string>() + "; " +
         origin["compiler"].get<std::string>() + "; commit " + origin["commit"].get<std::string>() + "; effort " +
         table["effort"].get<std::string>() + ", " + seconds_text(table["seconds"].get<double>()) + "*\n";
}

// The load counts this program, too.
std::string noise_line(const Json& table) {
  const double spread = table["largest_spread"].get<double>();
  if (spread <= noisy_spread) return "";
  const Json& origin = table["origin"];
  return "\n**Noisy:** rounds differ by up to ±" + print("%.0f %%", 100 * spread) + " of the median; " +
         print("%.1f", origin["load"].get<double>()) + " processes wanted to run on " +
         std::to_string(origin["cores"].get<int>()) + " cores when it began.\n";
}

std::string figures_markdown(const Json& table) {
  std::string head = "| |", rule = "|:--|";
  for (std::size_t c = 0; c < table["columns"].size(); ++c) {
    const std::string name = table["columns"][c]["name"];
    head += ' ' + name + " |";
    rule += "--:|";
    if (has_paper(table, c)) {
      head += " *in the paper* |";
      rule += "--:|";
    }
  }
  std::string text = head + '\n' + rule + '\n';
  for (const Json& row : table["rows"]) {
    text += "| " + row["name"].get<std::string>() + " |";
    for (std::size_t c = 0; c < table["columns"].size(); ++c) {
      const Json& figure = row["figures"][c];
      const std::string form = table["columns"][c]["form"];
      text += ' ' + measured_text(figure, form) + " |";
      if (!has_paper(table, c)) continue;
      text += figure.contains("paper") ? " *" + figure_text(figure["paper"].get<double>(), form) + "* |" : " |";
    }
    text += '\n';
  }
  return text;
}

std::string limit_text(const Json& claim) {
  const Json &least = claim["at_least"], &most = claim["at_most"];
  if (least.is_null()) return "at most " + three_digits(most.get<double>());
  if (most.is_null()) return "at least " + three_digits(least.get<double>());
  return three_digits(least.get<double>()) + " to " + three_digits(most.get<double>());
}

// What was measured, and how it stands to the limit.
std::string verdict_text(const Json& claim) {
  const std::string verdict = claim["verdict"];
  if (claim["measured"].is_null()) return verdict + ": not measured here";
  std::string text = verdict == "not comparable" ? verdict + ": " : "**" + verdict + "**: ";
  text += three_digits(claim["measured"].get<double>());
  if (claim["spread"].get<double>() > 0) text += spread_text(claim["spread"].get<double>());
  if (!claim["ratio_to_limit"].is_null()) {
    text += ", " + three_digits(claim["ratio_to_limit"].get<double>()) + " times the limit";
  }
  if (verdict == "not comparable") text += "; the noise is wider than the distance";
  return text;
}

// Why a claim holds or does not; empty where nobody looked into it. It is not kept with the figures: what is found out
// later is to be on the next page.
std::string reason(const Paper& paper, const Json& claim) {
  const auto found =
      std::find_if(paper.claims.begin(), paper.claims.end(), [&](const Claim& c) { return claim["id"] == c.id; });
  if (found == paper.claims.end()) return "";
  if (claim["verdict"] == "not comparable") return claim["measured"].is_null() ? "" : found->why_undecided;
  return claim["verdict"] == "holds" ? found->why_it_holds : found->why_it_fails;
}

std::string claims_markdown(const Paper& paper, const Json& table) {
  if (table["claims"].empty()) return "";
  std::string text = "\n| claim | where | what decides | limit | verdict |\n|:--|:--|:--|--:|:--|\n";
  for (const Json& claim : table["claims"]) {
    text += "| " + claim["text"].get<std::string>() + " | " + claim["source"].get<std::string>() + " | " +
            claim["ratio"].get<std::string>() + " | " + limit_text(claim) + " | " + verdict_text(claim) + " |\n";
  }
  for (const Json& claim : table["claims"]) {
    const std::string why = reason(paper, claim);
    if (why.empty()) continue;
    text += "\n* *" + claim["text"].get<std::string>() + "*: " + claim["verdict"].get<std::string>() + ". " + why;
  }
  return text + '\n';
}

std::string pictures_markdown(const Json& table) {
  std::string text;
  for (const Json& plot : table["plots"]) {
    text += "\n![" + plot["title"].get<std::string>() + "](plots/" + plot["name"].get<std::string>() + ".svg)\n";
  }
  const Json& pictures = table["pictures"];
  if (pictures.empty()) return text;
  text += "\n| | | |\n|:-:|:-:|:-:|\n";
  constexpr std::size_t columns = 3;
  for (std::size_t begin = 0; begin < pictures.size(); begin += columns) {
    std::string images = "|", names = "|";
    for (std::size_t i = begin; i < begin + columns; ++i) {
      if (i < pictures.size()) {
        images += " ![" + pictures[i]["title"].get<std::string>() + "](pictures/" +
                  pictures[i]["name"].get<std::string>() + ".png)";
        names += ' ' + pictures[i]["title"].get<std::string>();
      }
      images += " |", names += " |";
    }
    text += images + '\n' + names + '\n';
  }
  return text;
}

using VerdictCounts = std::map<std::string, int>;

VerdictCounts count_verdicts(const std::vector<Json>& tables, const std::string& paper) {
  VerdictCounts counts;
  for (const Json& table : tables) {
    if (table["paper"] != paper) continue;
    for (const Json& claim : table["claims"]) ++counts[claim["verdict"].get<std::string>()];
  }
  return counts;
}

}  // namespace

std::string figure_text(double value, const std::string& form) {
  if (form == "count") return print("%.0f", value);
  if (form == "seconds") return seconds_text(value);
  if (form == "bytes") return bytes_text(value);
  if (form == "percent") return three_digits(100 * value) + " %";
  if (form == "times") return three_digits(value) + " ×";
  return three_digits(value);
}

std::string table_markdown(const Paper& paper, const Json& table) {
  std::string text = "## " + table["title"].get<std::string>();
  const std::string source = table["source"];
  if (!source.empty()) text += " (" + source + ")";
  text += "\n\n" + table["about"].get<std::string>() + "\n\n" + figures_markdown(table);
  text += '\n' + origin_line(table) + noise_line(table);
  for (const Json& note : table["notes"]) text += "\n> " + note.get<std::string>() + '\n';
  return text + pictures_markdown(table) + claims_markdown(paper, table);
}

std::string page_markdown(const Paper& paper, const std::vector<Json>& tables) {
  std::string text =
      "# " + paper.title + "\n\n" + paper.reference + ".\n\n" + paper.summary +
      "\n\nTimes are CPU time, of one thread where nothing else is said: the median of rounds in which the contenders "
      "took turns. ± is half of the distance between the slowest and the fastest round, from five rounds on without "
      "the two at the ends; figures without it were counted, or timed once. Made by `./dev lab`; the figures are in "
      "[data](data).\n";
  for (const Json& table : tables) {
    if (table["paper"] == paper.id) text += '\n' + table_markdown(paper, table);
  }
  return text;
}

std::string index_markdown(const std::vector<Paper>& papers, const std::vector<Json>& tables) {
  std::string text =
      "# The lab\n\nThe papers' tables, measured again by `tenon lab`, beside the papers' figures. Which claims hold "
      "is "
      "derived from the figures: a claim is a limit on a ratio, and it holds where the whole range of the measurement "
      "keeps it, fails where none of it does, and is not comparable in between. Why is said where it was looked into. "
      "`./dev lab` makes these pages.\n\n| page | claims that hold | that do not | not comparable "
      "|\n|:--|--:|--:|--:|\n";
  for (const Paper& paper : papers) {
    VerdictCounts counts = count_verdicts(tables, paper.id);
    text += "| [" + paper.title + "](" + paper.id + ".md) | " + std::to_string(counts["holds"]) + " | " +
            std::to_string(counts["does not hold"]) + " | " + std::to_string(counts["not comparable"]) + " |\n";
  }
  for (const Paper& paper : papers) {
    if (paper.claims.empty()) continue;
    text += "\n## [" + paper.title + "](" + paper.id + ".md)\n\n";
    for (const Json& table : tables) {
      if (table["paper"] != paper.id) continue;
      for (const Json& claim : table["claims"]) {
        const std::string why = reason(paper, claim);
        text += "* " + claim["text"].get<std::string>() + " (" + claim["source"].get<std::string>() +
                "): " + verdict_text(claim) + '.' + (why.empty() ? "" : ' ' + why) + '\n';
      }
    }
  }
  return text;
}

}  // namespace tenon
