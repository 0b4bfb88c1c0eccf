#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/program_test.h"

namespace tenon {
namespace {

using Json = nlohmann::json;

class TraceCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("box.scad", "cube(2);");
  }
  Outcome trace(const std::string& rays, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"trace", "box.scad", "--rays", "-", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words, rays);
  }
};

TEST_F(TraceCommand, HitAndMissAsDocumented) {
  const Outcome outcome = trace("1 0.5 -3 0 0 2\n5 5 5 1 0 0\n");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::size_t end = outcome.out.find('\n');
  EXPECT_EQ(outcome.out.substr(end + 1), "{\"hit\":false}\n");
  const std::string first = outcome.out.substr(0, end);
  EXPECT_EQ(first.rfind("{\"hit\":true,\"t\":1.5,\"point\":[1,0.5,0],\"normal\":[", 0), 0U) << first;
  const Json json = Json::parse(first);
  EXPECT_EQ(json["normal"][2], -1);
  EXPECT_EQ(json["entering"], true);
  EXPECT_TRUE(json["primitive"].is_string());
  EXPECT_EQ(json["id"], 0);
}

TEST_F(TraceCommand, SpansOfTheWholeScene) {
  const Outcome outcome = trace("1 1 -3 0 0 1\n1 1 1 0 0 1\n5 5 5 0 0 1\n", {"--all"});
  EXPECT_EQ(outcome.out, "{\"spans\":[[3,5]]}\n{\"spans\":[[0,1]]}\n{\"spans\":[]}\n") << outcome.err;
}

TEST_F(TraceCommand, InfiniteEndIsNull) {
  write("half.scad", "halfspace(normal = [0, 0, 1], d = 0);");
  write("rays", "0 0 1 0 0 -1\n");
  const Outcome outcome = run({"trace", "half.scad", "--rays", "rays", "--all"});
  EXPECT_EQ(outcome.out, "{\"spans\":[[1,null]]}\n") << outcome.err;
}

TEST_F(TraceCommand, BlankLinesCommentsAndSigns) {
  const Outcome outcome = trace("# rays\n\n  \t\r\n+1 1 -3  0 0 1e0 # up\n");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
}

TEST_F(TraceCommand, ManyRaysInOrderForAnyThreads) {
  std::string rays;
  for (int i = 0; i < 5000; ++i) rays += "1 1 " + std::to_string(-1 - i) + " 0 0 1\n";
  const Outcome one = trace(rays, {"-j", "1"}), two = trace(rays, {"-j", "2"});
  EXPECT_EQ(one.out, two.out);
  std::istringstream lines(one.out);
  std::string line;
  for (int i = 0; i < 5000; ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    ASSERT_EQ(Json::parse(line)["t"], 1 + i);
  }
}

// Each line that is no ray, and where the message must point.
TEST_F(TraceCommand, WrongLinesAreErrorsWithTheirPlace) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"1 1 1 0 0 1\n1 2 3\n", ":2:6: error: "}, {"1 2 3 4 5 6 7\n", ":1:13: error: "},
      {"1 2 x 4 5 6\n", ":1:5: error: "},        {"\n1 2 3 0 0 0\n", ":2:7: error: "},
      {"1 2 3 0 0 inf\n", ":1:11: error: "},     {"nan 2 3 0 0 1\n", ":1:1: error: "},
      {"1 2 3 0 0 1e999\n", ":1:11: error: "},   {std::string("\x00\x01\x02", 3), ":1:1: error: "},
      {"1,2,3,0,0,1\n", ":1:1: error: "}};
  for (const auto& [rays, part] : wrong) {
    const Outcome outcome = trace(rays);
    EXPECT_EQ(outcome.status, 1) << rays;
    EXPECT_TRUE(contains(outcome.err, part)) << rays << outcome.err;
    EXPECT_EQ(outcome.out, "") << rays;
  }
  EXPECT_EQ(run({"trace", "box.scad", "--rays", "missing"}).status, 1);
  EXPECT_EQ(run({"trace", "box.scad", "--rays", "."}).status, 1);
}

TEST_F(TraceCommand, NoRaysNoAnswers) {
  const Outcome outcome = trace("");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace tenon
