#include <nlohmann/json.hpp>

#include "apps/program_test.h"
#include "tenon/image/picture_file.h"

namespace tenon {
namespace {

using Json = nlohmann::json;

class HeatMapOption : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("ball.scad", "difference() { sphere(1); for (z = [-1, 1]) translate([0, 0, z]) cube(1, center = true); }\n");
  }
  std::vector<std::string> render(std::vector<std::string> more) const {
    more.insert(more.begin(), {"render", "ball.scad", "--size", "48x32", "--spp", "1", "-q"});
    return more;
  }
};

TEST_F(HeatMapOption, ValuesOfTheExrSumToTheStatistics) {
  for (const std::string accel : {"okd", "none", "cells", "ropes"}) {
    for (const auto& [cost, name] : {std::pair("tests", "primitive_tests"), std::pair("cells", "cells_visited")}) {
      const Outcome outcome =
          run(render({"--accel", accel, "--heatmap", cost, "-o", "map.exr", "--stats", "map.json"}));
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      const Result<Picture> map = decode_exr(read("map.exr"), "map.exr");
      ASSERT_TRUE(map.ok());
      const PictureChannel* values = map->find("Y");
      ASSERT_NE(values, nullptr);
      ASSERT_EQ(values->values.size(), 48U * 32U);
      double sum = 0;
      for (const float v : values->values) sum += v;
      EXPECT_EQ(sum, Json::parse(read("map.json"))[name].get<double>()) << accel;
      ASSERT_NE(map->note("Heatmap"), nullptr);
      EXPECT_TRUE(contains(*map->note("Heatmap"), accel));
    }
  }
}

TEST_F(HeatMapOption, StatisticsAreThoseOfThePicture) {
  ASSERT_EQ(run(render({"--accel", "okd", "-o", "p.png", "--stats", "picture.json"})).status, 0);
  ASSERT_EQ(run(render({"--accel", "okd", "--heatmap", "time", "-o", "m.png", "--stats", "map.json"})).status, 0);
  const Json picture = Json::parse(read("picture.json")), map = Json::parse(read("map.json"));
  for (const char* name : {"rays", "per_kind", "primitive_tests", "cells_visited", "mailbox_hits", "accel"}) {
    EXPECT_EQ(picture[name], map[name]) << name;
  }
}

TEST_F(HeatMapOption, CountsAreTheSameBytesForAnyNumberOfThreads) {
  ASSERT_EQ(run(render({"--heatmap", "tests", "-o", "one.png", "-j", "1"})).status, 0);
  ASSERT_EQ(run(render({"--heatmap", "tests", "-o", "three.png", "-j", "3"})).status, 0);
  EXPECT_EQ(read("one.png"), read("three.png"));
}

TEST_F(HeatMapOption, WhatShowsLightIsRefusedBesideIt) {
  for (const std::string other : {"--denoise", "--transparent", "--noise=0.1", "--checkpoint=c.exr", "--animate=2"}) {
    const Outcome outcome = run(render({"--heatmap", "tests", other, "-o", "map.exr"}));
    EXPECT_EQ(outcome.status, 2) << other;
    EXPECT_TRUE(contains(outcome.err, other.substr(0, other.find('=')))) << outcome.err;
  }
  EXPECT_EQ(run(render({"--heatmap", "costs"})).status, 2);
}

}  // namespace
}  // namespace tenon
