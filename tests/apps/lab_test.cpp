#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "apps/program_test.h"
#include "lab/claim.h"
#include "lab/page.h"

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
  EXPECT_TRUE(contains(outcome_of(good, "").err, "scenes/ima1.scad"));  // the papers are read, the scenes are missing
  EXPECT_TRUE(contains(outcome_of(short_row, "").err, "another length"));
  EXPECT_TRUE(contains(outcome_of(no_row, "").err, "a row for each name"));
  EXPECT_TRUE(contains(outcome_of(good, no_limit).err, "no limit"));
  EXPECT_EQ(outcome_of("3", "").status, 1);
}

}  // namespace
}  // namespace tenon
