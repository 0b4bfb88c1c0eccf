#include "apps/program_test.h"

namespace tenon {
namespace {

class Usage : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("a.scad", "sphere(1);");
  }
};

TEST_F(Usage, HelpAndVersionOfEveryCommand) {
  const std::vector<std::vector<std::string>> commands{{},        {"render"}, {"merge"},  {"denoise"},
                                                       {"trace"}, {"info"},   {"convert"}};
  for (std::vector<std::string> words : commands) {
    words.push_back("--help");
    const Outcome help = run(words);
    EXPECT_EQ(help.status, 0);
    EXPECT_TRUE(contains(help.out, "--version")) << help.out;
    EXPECT_EQ(help.err, "");
    words.back() = "--version";
    const Outcome version = run(words);
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.out.rfind("tenon ", 0), 0U) << version.out;
  }
}

// Each wrong command line, and what its message must name.
TEST_F(Usage, ErrorsSayWhatIsWrongAndWriteNothing) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong{
      {{}, "render, merge, denoise, trace, compare, info, convert"},
      {{"compair", "a.scad"},
       "'compair' (did you mean 'compare'?); there are: render, merge, denoise, trace, compare, info, convert"},
      {{"a.scad"}, "there is no command 'a.scad'; for a picture of it: tenon render a.scad"},
      {{"render", "a.scad", "--sise", "3x3"}, "there is no option '--sise' (did you mean '--size'?)"},
      {{"render", "a.scad", "--sise=3x3"}, "there is no option '--sise' (did you mean '--size'?)"},
      {{"--frobnicate"}, "--frobnicate"},
      {{"render"}, "SCENE"},
      {{"render", "a.scad", "--frobnicate"}, "--frobnicate"},
      {{"render", "a.scad", "b.scad"}, "b.scad"},
      {{"render", "a.scad", "-o"}, "--output"},
      {{"render", "a.scad", "-o", "x.jpg"}, ".png, .exr"},
      {{"render", "a.scad", "-o", "x"}, ".png, .exr"},
      {{"render", "a.scad", "--size", "640"}, "--size"},
      {{"render", "a.scad", "--size", "0x10"}, "--size"},
      {{"render", "a.scad", "--size", "-3x10"}, "--size"},
      {{"render", "a.scad", "--size", "10x65536"}, "65535"},
      {{"render", "a.scad", "--size", "10x10x10"}, "--size"},
      {{"render", "a.scad", "--size", "99999999999999x2"}, "--size"},
      {{"render", "a.scad", "--spp", "0"}, "--spp"},
      {{"render", "a.scad", "--spp", "many"}, "--spp"},
      {{"render", "a.scad", "--depth", "0"}, "--depth"},
      {{"render", "a.scad", "--threads", "-1"}, "--threads"},
      {{"render", "a.scad", "--threads", "1e9"}, "--threads"},
      {{"render", "a.scad", "--integrator", "magic"}, "'magic'; there are: whitted, path"},
      {{"render", "a.scad", "--accel", "magic"}, "'magic'; there are: none"},
      {{"render", "a.scad", "--accel", "none:x=1"}, "none"},
      {{"render", "a.scad", "--bits", "32"}, "8 or 16"},
      {{"render", "a.scad", "--ortho", "--aperture", "1"}, "--aperture"},
      {{"render", "a.scad", "-o", "x.exr", "--bits", "8"}, "16 or 32"},
      {{"render", "a.scad", "--camera", "1,2,3"}, "--camera"},
      {{"render", "a.scad", "--camera", "1,2,3,4,5,6,7,8"}, "--camera"},
      {{"render", "a.scad", "--camera", "1,2,3,x,5,6"}, "--camera"},
      {{"render", "a.scad", "--camera", "-1,2,3,-1,2,3"}, "stands where it looks"},
      {{"render", "a.scad", "--camera", "1,2,3,4,5,6,180"}, "field of view"},
      {{"render", "a.scad", "-D", "x"}, "name=value"},
      {{"render", "a.scad", "--facets", "perhaps"}, "--facets"},
      {{"render", "-"}, "-o"},
      {{"render", "a.scad", "-o", "-", "--stats", "-"}, "standard output"},
      {{"render", "a.scad", "--crop", "1,2,3"}, "--crop takes x0,y0,x1,y1"},
      {{"render", "a.scad", "--crop", "0,0,641,10"}, "within 640x480"},
      {{"render", "a.scad", "--crop", "9,9,9,10"}, "--crop"},
      {{"render", "a.scad", "--samples", "0:9"}, "of the 4 that --spp asks for"},
      {{"render", "a.scad", "--spp", "4", "--samples", "2:2"}, "--samples"},
      {{"render", "a.scad", "--spp", "4", "--samples", "0:2", "--noise", "0.1"}, "--crop in place of --samples"},
      {{"render", "a.scad", "--resume"}, "--checkpoint"},
      {{"render", "a.scad", "--time", "0"}, "--time"},
      {{"render", "a.scad", "--denoise", "--spp", "1"}, "take two of them at least, with --spp"},
      {{"render", "a.scad", "--denoise", "--spp", "8", "--samples", "3:4"}, "take two of them at least, with --spp"},
      {{"render", "a.scad", "--hatch-angle", "30"}, "--hatch"},
      {{"render", "a.scad", "--animate", "0"}, "--animate"},
      {{"render", "a.scad", "--animate", "2", "-o", "-"}, "--animate goes with files"},
      {{"render", "a.scad", "--layers", "Z"}, "a PNG picture has no layers"},
      {{"render", "a.scad", "-o", "x.exr", "--layers", "Q"}, "no layer 'Q'; there are: all, none, Z"},
      {{"render", "a.scad", "-o", "x.exr", "--tonemap", "filmic"}, "EXR picture keeps the light"},
      {{"render", "a.scad", "--tonemap", "pretty"}, "--tonemap"},
      {{"render", "a.scad", "--format", "gif"}, "--format"},
      {{"merge", "-o", "x.png"}, "PICTURES"},
      {{"merge", "a.exr"}, "-o"},
      {{"trace", "a.scad"}, "--rays"},
      {{"trace", "-", "--rays", "-"}, "standard input"},
      {{"convert", "a.scad"}, "--output"},
      {{"convert", "a.scad", "-o", "a.stl"}, "'.stl' is not supported yet; there is: .csg"},
      {{"info"}, "SCENE"},
  };
  for (const auto& [words, part] : wrong) {
    const Outcome outcome = run(words, "sphere(1);");
    std::string line;
    for (const std::string& word : words) line += ' ' + word;
    EXPECT_EQ(outcome.status, 2) << line;
    EXPECT_TRUE(contains(outcome.err, part)) << line << ": " << outcome.err;
    EXPECT_EQ(outcome.err.rfind("tenon: error: ", 0), 0U) << outcome.err;
    EXPECT_EQ(outcome.out, "") << line;
    EXPECT_EQ(files(), 1U) << line;
  }
}

TEST_F(Usage, PictureLargerThanTheMachineIsRefused) {
  if (static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) > 257e9) GTEST_SKIP();
  const Outcome outcome = run({"render", "a.scad", "--size", "65535x65535"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_TRUE(contains(outcome.err, "257.7 GB")) << outcome.err;
}

}  // namespace
}  // namespace tenon
