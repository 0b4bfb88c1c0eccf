#include <nlohmann/json.hpp>

#include "apps/program_test.h"

namespace tenon {
namespace {

using Json = nlohmann::json;

class InfoAndConvert : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("a.scad", "n = 3; difference() { cube(4); for (i = [0:n - 1]) translate([i, 0, 0]) sphere(0.5); }");
  }
};

TEST_F(InfoAndConvert, InfoCounts) {
  const Outcome outcome = run({"info", "a.scad", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["primitives"], 4);
  EXPECT_EQ(json["primitives_by_kind"]["sphere"], 3);
  EXPECT_EQ(json["bounds"]["lower"].size(), 3U);
  EXPECT_NEAR(json["bounds"]["upper"][2].get<double>(), 4, 1e-6);
  for (const char* name : {"operations", "depth", "tolerance", "materials", "lights"}) {
    EXPECT_TRUE(json.contains(name)) << name;
  }
  EXPECT_EQ(Json::parse(run({"info", "-", "--json", "-D", "n=5"}, read("a.scad")).out)["primitives"], 6);
}

TEST_F(InfoAndConvert, InfoInWords) {
  const Outcome outcome = run({"info", "a.scad"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "primitives  4: ")) << outcome.out;
}

TEST_F(InfoAndConvert, UnboundedEndsAreNull) {
  write("half.scad", "halfspace(normal = [0, 0, 1], d = 0);");
  const Outcome outcome = run({"info", "half.scad", "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(Json::parse(outcome.out)["bounds"]["lower"][0].is_null()) << outcome.out;
}

TEST_F(InfoAndConvert, ConvertedTreeIsTheSameScene) {
  ASSERT_EQ(run({"convert", "a.scad", "-o", "b.csg"}).status, 0);
  EXPECT_EQ(run({"info", "a.scad", "--json"}).out, run({"info", "b.csg", "--json"}).out);
  EXPECT_EQ(run({"convert", "b.csg", "-o", "-"}).out, read("b.csg"));
  const std::string ray = "0.1 0.2 9 0.1 0.1 -1\n";
  const Outcome traced = run({"trace", "a.scad", "--rays", "-"}, ray);
  ASSERT_EQ(traced.status, 0) << traced.err;
  EXPECT_EQ(traced.out, run({"trace", "b.csg", "--rays", "-"}, ray).out);
}

TEST_F(InfoAndConvert, ConvertsToPovRay) {
  ASSERT_EQ(run({"convert", "a.scad", "-o", "a.pov"}).status, 0);
  EXPECT_TRUE(contains(read("a.pov"), "difference {")) << read("a.pov");
}

TEST_F(InfoAndConvert, WrongScenesLeaveNothing) {
  write("bad.scad", "cube(");
  const std::size_t before = files();
  EXPECT_EQ(run({"convert", "bad.scad", "-o", "b.csg"}).status, 1);
  EXPECT_EQ(run({"info", "bad.scad"}).status, 1);
  EXPECT_EQ(run({"info", "missing.scad"}).status, 1);
  EXPECT_EQ(files(), before);
}

TEST_F(InfoAndConvert, FullStandardOutputIsAMachineError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  const std::string line = "cd " + folder.string() + " && " TENON_PROGRAM " info a.scad >/dev/full 2>err";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3);
  EXPECT_TRUE(contains(read("err"), "standard output")) << read("err");
}

}  // namespace
}  // namespace tenon
