#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "apps/program_test.h"
#include "lab/claim.h"
#include "lab/lab_json.h"
#include "lab/page.h"
#include "lab/ratios.h"
#include "tenon/accel/accelerator.h"

namespace tenon {
namespace {

using Json = nlohmann::ordered_json;

Claim at_least(double limit) {
  Claim claim;
  claim.at_least = limit;
  return claim;
}

TEST(LabClaim, VerdictFollowsFromTheFigure) {
  EXPECT_EQ(judge(at_least(2), Measured{3, 0}).verdict, Verdict::holds);
  EXPECT_EQ(judge(at_least(2), Measured{2, 0}).verdict, Verdict::holds);
  EXPECT_EQ(judge(at_least(2), Measured{1.9, 0}).verdict, Verdict::fails);
  Claim range = at_least(2);
  range.at_most = 4;
  EXPECT_EQ(judge(range, Measured{3, 0}).verdict, Verdict::holds);
  EXPECT_EQ(judge(range, Measured{4.1, 0}).verdict, Verdict::fails);
  EXPECT_EQ(judge(range, Measured{1.9, 0}).verdict, Verdict::fails);
  EXPECT_EQ(judge(range, Measured{3, 0}).ratio_to_limit, std::nullopt);
  EXPECT_EQ(judge(range, Measured{5, 0}).ratio_to_limit, 5.0 / 4);
  EXPECT_EQ(judge(range, Measured{1, 0}).ratio_to_limit, 1.0 / 2);
}

TEST(LabClaim, NoiseThatReachesOverTheLimitDecidesNothing) {
  EXPECT_EQ(judge(at_least(2), Measured{2.1, 0.1}).verdict, Verdict::not_comparable);
  EXPECT_EQ(judge(at_least(2), Measured{1.9, 0.1}).verdict, Verdict::not_comparable);
  EXPECT_EQ(judge(at_least(2), Measured{2.3, 0.1}).verdict, Verdict::holds);
  EXPECT_EQ(judge(at_least(2), Measured{1.7, 0.1}).verdict, Verdict::fails);
}

TEST(LabClaim, WhatWasNotMeasuredIsNotComparable) {
  EXPECT_EQ(judge(at_least(2), std::nullopt).verdict, Verdict::not_comparable);
  EXPECT_EQ(judge(at_least(2), Measured{std::nan(""), 0}).verdict, Verdict::not_comparable);
}

TEST(LabRatios, MeansAndEndsKeepTheirSpreads) {
  Ratios ratios;
  ratios.add({2, 0.1});
  ratios.add({8, 0.3});
  EXPECT_NEAR(ratios.mean().value, 4, 1e-12);
  EXPECT_NEAR(ratios.mean().spread, 0.2, 1e-12);
  EXPECT_EQ(ratios.least().value, 2);
  EXPECT_EQ(ratios.largest().spread, 0.3);
  const Measured quotient = divided(Measured{8, 0.1}, Measured{2, 0.2});
  EXPECT_EQ(quotient.value, 4);
  EXPECT_NEAR(quotient.spread, 0.3, 1e-12);
  EXPECT_FALSE(divided(std::optional<Measured>(), std::optional(quotient)));
}

TEST(LabPage, FiguresHaveThreeDigitsAndAUnitThatSuitsThem) {
  EXPECT_EQ(figure_text(0.0001234, "seconds"), "123 µs");
  EXPECT_EQ(figure_text(50040, "seconds"), "13.9 h");
  EXPECT_EQ(figure_text(2048, "bytes"), "2.00 KiB");
  EXPECT_EQ(figure_text(0.3996, "percent"), "40.0 %");
  EXPECT_EQ(figure_text(251, "count"), "251");
}

class Lab : public ProgramTest {
 protected:
  const std::string root = TENON_ROOT;
  Json parse(const std::string& path) const { return Json::parse(std::ifstream(path)); }
};

// Every figure of the papers' files stands beside one of ours: names of rows and columns agree.
std::size_t count_paper_figures(const Json& tables) {
  std::size_t count = 0;
  for (const Json& table : tables) {
    for (const Json& row : table["rows"]) {
      for (const Json& figure : row["figures"]) count += figure.contains("paper") ? 1 : 0;
    }
  }
  return count;
}

const Json& named(const Json& list, const char* key, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Json& item) { return item[key] == name; });
  if (found == list.end()) throw std::out_of_range("there is no " + name);
  return *found;
}

/// The figures of a measured table, by name.
class Figures {
 public:
  Figures(const Json& tables, const std::string& table) : table_(named(tables, "table", table)) {}

  std::vector<std::string> rows() const { return names(table_["rows"]); }
  std::vector<std::string> columns() const { return names(table_["columns"]); }
  double operator()(const std::string& row, const std::string& column) const {
    const std::vector<std::string> all = columns();
    const auto c = static_cast<std::size_t>(std::find(all.begin(), all.end(), column) - all.begin());
    return named(table_["rows"], "name", row)["figures"].at(c)["value"].get<double>();
  }
  double claim(const std::string& id) const { return named(table_["claims"], "id", id)["measured"].get<double>(); }

 private:
  static std::vector<std::string> names(const Json& list) {
    std::vector<std::string> all;
    for (const Json& item : list) all.push_back(item["name"]);
    return all;
  }

  const Json& table_;
};

// What is derived from other figures of its row, and the claims, are what they say they are. With one round the median
// of ratios is the ratio of medians.
void check_derived_figures(const Json& tables) {
  const Figures gain(tables, "rr612-2"), growth(tables, "rr612-4"), levels(tables, "rr612-levels");
  for (const std::string& row : gain.rows()) {
    EXPECT_NEAR(gain(row, "gain factor"), gain(row, "traditional") / gain(row, "space tracing"), 1e-9) << row;
    EXPECT_LT(gain(row, "tests a ray, space tracing"), gain(row, "tests a ray, traditional")) << row;
  }
  EXPECT_NEAR(gain.claim("gain-ima2"), gain("IMA2", "gain factor"), 1e-9);
  EXPECT_NEAR(growth.claim("grows"),
              growth("72 primitives", "traditional a ray") / growth("8 primitives", "traditional a ray"), 1e-9);
  for (const std::string& row : levels.rows()) {
    EXPECT_NEAR(levels(row, "sub-grids over one grid"), levels(row, "sub-grids") / levels(row, "one grid"), 1e-9);
  }
  const Figures turns(tables, "okd-turns"), ropes(tables, "rope-trees-2"), stadium(tables, "scaling-stadium");
  for (const std::string& row : turns.rows()) {
    EXPECT_NEAR(turns(row, "NBVH over OKD-tree (MSAH)"),
                turns(row, "CSG with NBVH") / turns(row, "CSG with OKD-tree (MSAH)"), 1e-9);
    EXPECT_TRUE(row == "1 turn" || turns.claim("turns") <= turns(row, "NBVH over OKD-tree (MSAH)"));
  }
  EXPECT_NEAR(ropes("Teapot, rope-trees", "speedup S1"),
              ropes("Teapot, bsp", "render TR") / ropes("Teapot, rope-trees", "render TR") - 1, 1e-9);
  for (const std::string& row : stadium.rows()) {
    EXPECT_NEAR(stadium(row, "slowdown"), stadium(row, "in the stadium") / stadium(row, "alone"), 1e-9) << row;
  }
}

// What is asked of every structure is measured for every structure, and work is what it must be.
void check_structures(const Json& tables, const std::vector<std::string>& structures) {
  const Figures work(tables, "work"), stadium(tables, "scaling-stadium");
  EXPECT_EQ(work.rows(), structures);
  EXPECT_EQ(Figures(tables, "scaling-size").columns(), structures);
  EXPECT_EQ(Figures(tables, "scaling-overlap").columns(), structures);
  const std::vector<std::string> in_stadium = stadium.rows();
  for (auto s = structures.begin() + 1; s != structures.end(); ++s) {
    EXPECT_EQ(std::count(in_stadium.begin(), in_stadium.end(), *s), 1) << *s;
  }
  EXPECT_EQ(named(tables, "table", "work")["pictures"].size(), 3 * structures.size());
  for (const std::string& s : structures) EXPECT_LE(work(s, "tests a pixel"), work("none", "tests a pixel")) << s;
}

TEST_F(Lab, EveryTableHasPlausibleFiguresAndThePapersBesideThem) {
  const Outcome outcome = run({"lab", "--root", root, "--scale", "0.05", "-o", "pages", "--json", "all.json", "-q"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json tables = Json::parse(read("all.json"));
  ASSERT_GE(tables.size(), 5U);
  std::set<std::string> papers, claims;
  for (const Json& table : tables) {
    const std::string id = table["table"];
    papers.insert(table["paper"]);
    EXPECT_FALSE(table["origin"]["machine"].get<std::string>().empty());
    EXPECT_FALSE(table["rows"].empty() && table["pictures"].empty()) << id;
    for (const Json& note : table["notes"]) EXPECT_FALSE(contains(note, "took another picture")) << id << note;
    for (const Json& row : table["rows"]) {
      EXPECT_EQ(row["figures"].size(), table["columns"].size()) << id << ' ' << row["name"];
      for (std::size_t c = 0; c < row["figures"].size(); ++c) {
        const Json& value = row["figures"][c]["value"];
        // What is gained may be lost, in percent; nothing else is below 0.
        const double least = table["columns"][c]["form"] == "percent" ? -100 : 0;
        EXPECT_TRUE(value.is_null() || value.get<double>() >= least) << id << ' ' << row;
      }
    }
    for (const Json& claim : table["claims"]) {
      EXPECT_TRUE(claims.insert(table["paper"].get<std::string>() + ' ' + claim["id"].get<std::string>()).second);
      EXPECT_FALSE(claim["verdict"].get<std::string>().empty());
    }
    for (const Json& picture : table["pictures"]) {
      EXPECT_TRUE(std::filesystem::exists(folder / ("pages/pictures/" + picture["name"].get<std::string>() + ".png")));
    }
    EXPECT_EQ(Json::parse(read("pages/data/" + id + ".json")), table);
    EXPECT_TRUE(contains(read("pages/" + table["paper"].get<std::string>() + ".md"), table["title"])) << id;
  }
  std::size_t printed = 0, claimed = 0;
  for (const std::string& name : papers) {
    const Json paper = parse(root + "/lab/papers/" + name + ".json");
    for (const auto& table : paper["tables"]) {
      for (const Json& row : table["figures"]) {
        for (const Json& figure : row) printed += figure.is_null() ? 0 : 1;
      }
    }
    claimed += paper["claims"].size();
  }
  EXPECT_EQ(count_paper_figures(tables), printed);
  EXPECT_EQ(claims.size(), claimed) << "a claim is not judged";
  EXPECT_TRUE(contains(read("pages/README.md"), "claims that hold"));
  check_derived_figures(tables);
  std::vector<std::string> structures;
  for (const std::string_view name : accelerator_names()) structures.emplace_back(name);
  check_structures(tables, structures);
}

// The pages that are in the repository.
TEST_F(Lab, CommittedPagesAreOfAFullRunAndSayWhatTheirFiguresSay) {
  const std::filesystem::path pages = root + "/docs/lab";
  std::filesystem::create_directories(folder / "again/data");
  for (const auto& file : std::filesystem::directory_iterator(pages / "data")) {
    std::filesystem::copy(file.path(), folder / "again/data" / file.path().filename());
    const Json table = parse(file.path());
    EXPECT_EQ(table["effort"], "full") << file.path();
    EXPECT_FALSE(contains(table["origin"]["commit"], "+")) << file.path() << " was measured with other sources";
    const Json paper = parse(root + "/lab/papers/" + table["paper"].get<std::string>() + ".json");
    for (const Json& claim : table["claims"]) {
      const std::string verdict = claim["verdict"];
      if (verdict == "not comparable") continue;
      const Json& known = named(paper["claims"], "id", claim["id"]);
      EXPECT_TRUE(known.contains(verdict == "holds" ? "why_it_holds" : "why_it_fails"))
          << known["id"] << ' ' << verdict;
    }
  }
  ASSERT_EQ(run({"lab", "--root", root, "--pages", "-o", "again"}).status, 0);
  for (const auto& file : std::filesystem::directory_iterator(pages)) {
    if (file.path().extension() != ".md") continue;
    std::ostringstream committed;
    committed << std::ifstream(file.path(), std::ios::binary).rdbuf();
    EXPECT_EQ(read("again/" + file.path().filename().string()), committed.str())
        << "write them again: tenon lab --pages -o docs/lab";
  }
}

// Each curve is in the drawing by name, and an end at the time limit is marked.
TEST_F(Lab, CommittedPlotsAreThoseOfTheFigures) {
  const std::filesystem::path pages = root + "/docs/lab";
  std::size_t plots = 0;
  for (const auto& file : std::filesystem::directory_iterator(pages / "data")) {
    const Json table = parse(file.path());
    for (const Json& plot : table["plots"]) {
      std::ostringstream text;
      text << std::ifstream(pages / "plots" / (plot["name"].get<std::string>() + ".svg")).rdbuf();
      const std::string drawing = text.str();
      ++plots;
      EXPECT_TRUE(contains(drawing, plot["title"])) << plot["name"];
      EXPECT_TRUE(contains(drawing, plot["y_label"])) << plot["name"];
      bool cut_off = false;
      for (const Json& series : plot["series"]) {
        EXPECT_TRUE(contains(drawing, ">" + series["name"].get<std::string>() + "<")) << series["name"];
        cut_off = cut_off || series["cut_off"];
      }
      EXPECT_EQ(contains(drawing, "ends at the time limit"), cut_off) << plot["name"];
    }
  }
  EXPECT_GE(plots, 8U);
}

TEST_F(Lab, PlotsAreDrawn) {
  if (std::system("/usr/bin/python3 -c 'import matplotlib' 2>/dev/null") != 0) GTEST_SKIP() << "no matplotlib";
  std::filesystem::create_directories(folder / "data");
  write("data/t.json", R"({"plots": [{"name": "p", "title": "The title", "x_label": "x", "y_label": "y",
      "logarithmic_x": true, "logarithmic_y": true, "series": [
        {"name": "ends", "x": [1, 10], "y": [2, 200], "cut_off": true},
        {"name": "goes on", "x": [1, 10, 100], "y": [3, 4, 5], "cut_off": false},
        {"name": "has no point", "x": [], "y": [], "cut_off": false}]}]})");
  ASSERT_EQ(std::system(("/usr/bin/python3 '" + root + "/lab/plot.py' '" + folder.string() + "'").c_str()), 0);
  const std::string drawing = read("plots/p.svg");
  for (const char* part : {">The title<", ">ends<", ">goes on<", ">ends at the time limit<"}) {
    EXPECT_TRUE(contains(drawing, part)) << part;
  }
  EXPECT_FALSE(contains(drawing, "has no point"));
  // The legend is in the order of the curves' ends.
  EXPECT_LT(drawing.find(">ends<"), drawing.find(">goes on<"));
}

// The reason on a page is that of the verdict, as the paper's file has it now.
TEST(LabPage, ReasonsFollowTheVerdict) {
  Paper paper;
  paper.claims = {Claim{"c", "text", "source", "ratio", 1, {}, "since A", "since B", "since C"}};
  const auto page = [&](const std::optional<Measured>& measured) {
    LabTable table;
    table.id = "t";
    table.claims = {judge(paper.claims[0], measured)};
    return table_markdown(paper, lab_json(table, paper, {}, "full", 1));
  };
  EXPECT_TRUE(contains(page(Measured{2, 0}), "holds. since A"));
  EXPECT_TRUE(contains(page(Measured{0.5, 0}), "does not hold. since B"));
  EXPECT_TRUE(contains(page(Measured{1, 0.1}), "not comparable. since C"));
  EXPECT_FALSE(contains(page(std::nullopt), "since"));
}

TEST_F(Lab, OneTableIsPrintedAsMarkdown) {
  const Outcome outcome = run({"lab", "rr612-1", "--root", root, "-q"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "| IMA2 | 72 | *72* |")) << outcome.out;
}

TEST_F(Lab, MistakesAreSaidToTheUser) {
  Outcome outcome = run({"lab", "rr612-9", "--root", root});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(contains(outcome.err, "rr612-1")) << outcome.err;
  outcome = run({"lab", "rr612-1"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.err, "--root")) << outcome.err;
  EXPECT_EQ(run({"lab", "--pages", "--root", root}).status, 2);
}

TEST_F(Lab, PapersFilesAreChecked) {
  std::filesystem::create_directories(folder / "lab/papers");
  const auto outcome_of = [&](const std::string& table, const std::string& claims) {
    write("lab/papers/rr612.json", R"({"title": "t", "reference": "r", "summary": "s", "tables": {"rr612-1": )" +
                                       table + R"(}, "claims": [)" + claims + "]}");
    return run({"lab", "rr612-1"});
  };
  const std::string good = R"({"source": "t", "rows": ["a"], "columns": ["b", "c"], "figures": [[1, null]]})";
  const std::string short_row = R"({"source": "t", "rows": ["a"], "columns": ["b", "c"], "figures": [[1]]})";
  const std::string no_row = R"({"source": "t", "rows": ["a", "d"], "columns": ["b", "c"], "figures": [[1, 2]]})";
  const std::string no_limit = R"({"id": "i", "text": "t", "source": "s", "ratio": "r"})";
  const std::string zero_limit = R"({"id": "i", "text": "t", "source": "s", "ratio": "r", "at_most": 0})";
  EXPECT_TRUE(contains(outcome_of(good, "").err, "scenes/ima1.scad"));  // the papers are read, the scenes are missing
  EXPECT_TRUE(contains(outcome_of(short_row, "").err, "another length"));
  EXPECT_TRUE(contains(outcome_of(no_row, "").err, "a row for each name"));
  EXPECT_TRUE(contains(outcome_of(good, no_limit).err, "no limit"));
  EXPECT_TRUE(contains(outcome_of(good, zero_limit).err, "not over 0"));
  EXPECT_EQ(outcome_of("3", "").status, 1);
}

}  // namespace
}  // namespace tenon
