#include <png.h>
#include <sys/resource.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <tuple>

#include "apps/program_test.h"

namespace tenon {
namespace {

using Json = nlohmann::json;

struct Picture {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb;

  std::vector<int> at(int x, int y) const {
    const std::size_t i = 3 * static_cast<std::size_t>(y * width + x);
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

Picture decode(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return {};
  image.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(image));
  png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr);
  return picture;
}

class RenderCommand : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("ball.scad", "difference() { sphere(1); translate([0, 0, 1]) cube(1, center = true); }\n");
  }
};

TEST_F(RenderCommand, PictureIsNamedAfterTheSceneAndShowsIt) {
  const Outcome outcome = run({"render", "ball.scad", "--size", "64x48"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(contains(outcome.err, "ball.png: 64x48")) << outcome.err;
  const Picture picture = decode(read("ball.png"));
  ASSERT_EQ(picture.width, 64);
  ASSERT_EQ(picture.height, 48);
  EXPECT_NE(picture.at(32, 24), picture.at(0, 0));
  EXPECT_EQ(picture.at(63, 47), picture.at(0, 0));
  EXPECT_EQ(files(), 2U);
}

TEST_F(RenderCommand, SameBytesForAnyNumberOfThreads) {
  for (const std::string output : {"out.png", "out.exr"}) {
    std::set<std::string> all;
    for (const std::string threads : {"1", "2", "auto"}) {
      const Outcome outcome =
          run({"render", "ball.scad", "-q", "--size", "70x50", "--spp", "3", "--threads", threads, "-o", output});
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      all.insert(read(output));
    }
    EXPECT_EQ(all.size(), 1U);
  }
}

TEST_F(RenderCommand, StandardInputAndStandardOutput) {
  const Outcome outcome = run({"render", "-", "-o", "-", "--size", "20x10", "--quiet"}, "sphere(1);");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(decode(outcome.out).width, 20);
  EXPECT_EQ(files(), 1U);
}

TEST_F(RenderCommand, FormatsAndBits) {
  const std::vector<std::tuple<std::string, std::string, std::string>> formats{
      {"a.png", "8", "\x89PNG"}, {"b.png", "16", "\x89PNG"}, {"c.exr", "16", "v/1\x01"}, {"d.EXR", "32", "v/1\x01"}};
  for (const auto& [name, bits, begins] : formats) {
    ASSERT_EQ(run({"render", "ball.scad", "-q", "--size", "8x8", "--bits", bits, "-o", name}).status, 0);
    EXPECT_EQ(read(name).substr(0, 4), begins) << name;
  }
}

TEST_F(RenderCommand, FormatOnTheCommandLine) {
  const Outcome exr = run({"render", "ball.scad", "-q", "--size", "8x8", "-o", "-", "--format", "exr"});
  EXPECT_EQ(exr.out.substr(0, 4), "v/1\x01");
  ASSERT_EQ(run({"render", "ball.scad", "-q", "--size", "8x8", "-o", "picture", "--format", "png"}).status, 0);
  EXPECT_EQ(read("picture").substr(0, 4), "\x89PNG");
}

TEST_F(RenderCommand, ExposureAndToneCurveReachThePicture) {
  const auto shown = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"render", "ball.scad", "-q", "--size", "9x9", "-o", "x.png"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).status, 0);
    return decode(read("x.png")).at(4, 4)[0];
  };
  const int plain = shown({}), brighter = shown({"--exposure", "1"}), darker = shown({"--exposure", "-1"});
  EXPECT_GT(brighter, plain);
  EXPECT_LT(darker, plain);
  EXPECT_LT(shown({"--tonemap", "reinhard"}), plain);
  EXPECT_NE(shown({"--tonemap", "filmic"}), plain);
}

TEST_F(RenderCommand, CameraOnTheCommandLine) {
  write("two.scad",
        "color(\"red\") translate([-1, 0, 0]) sphere(0.5); color(\"blue\") translate([1, 0, 0]) sphere(0.5);");
  for (const bool orthographic : {false, true}) {
    std::vector<std::string> words{"render", "two.scad", "-q", "--size", "60x40", "--camera", "0,-5,0,0,0,0,60"};
    if (orthographic) words.push_back("--orthographic");
    ASSERT_EQ(run(words).status, 0);
    const Picture picture = decode(read("two.png"));
    const auto left = picture.at(19, 20), right = picture.at(40, 20);
    EXPECT_GT(left[0], left[2]);
    EXPECT_GT(right[2], right[0]);
  }
}

TEST_F(RenderCommand, CutsTakeTheirSideAway) {
  write("pair.scad", "color(\"red\") cube(10); color(\"blue\") translate([2, 2, 2]) cube(6);");
  const auto middle = [&](const std::vector<std::string>& cut) {
    std::vector<std::string> words{"render", "pair.scad", "-q", "--size", "40x40", "--camera", "5,5,60,5,5,0,20"};
    words.insert(words.end(), cut.begin(), cut.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return decode(read("pair.png"));
  };
  const Picture whole = middle({}), half = middle({"--cut", "x"}), plane = middle({"--cut", "-1,0,0,-5"});
  const Picture quarter = middle({"--cut", "x/y"}), both = middle({"--cut", "x=5", "--cut", "y=5"});
  const auto background = whole.at(0, 0);
  const auto left_low = std::pair{14, 26}, right_low = std::pair{26, 26}, right_high = std::pair{26, 14};
  const auto is_there = [&](const Picture& p, std::pair<int, int> at) {
    return p.at(at.first, at.second) != background;
  };
  EXPECT_TRUE(is_there(whole, left_low) && is_there(whole, right_low) && is_there(whole, right_high));
  EXPECT_TRUE(is_there(half, left_low) && !is_there(half, right_low));
  EXPECT_TRUE(!is_there(plane, left_low) && is_there(plane, right_low));
  EXPECT_TRUE(is_there(quarter, left_low) && is_there(quarter, right_low) && !is_there(quarter, right_high));
  EXPECT_TRUE(is_there(both, left_low) && !is_there(both, right_low) && !is_there(both, right_high));
}

TEST_F(RenderCommand, CutsThatAreNone) {
  for (const std::string cut : {"", "1,0,0", "w", "0,0,0,1", "x/", "x=", "--x", "1,0,0,nan1"}) {
    const Outcome outcome = run({"render", "ball.scad", "-q", "--cut", cut});
    EXPECT_EQ(outcome.status, 2) << cut << ": " << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "--cut takes a plane")) << cut << ": " << outcome.err;
  }
}

TEST_F(RenderCommand, HatchesLightAndLens) {
  const auto picture = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all{"render", "ball.scad", "-q", "--size", "60x40", "--cut", "-y", "-o", "ball.png"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return read("ball.png");
  };
  std::set<std::string> different;
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{},
                                             {"--hatch"},
                                             {"--hatch", "--hatch-angle", "-30"},
                                             {"--hatch", "--hatch-spacing", "0.3"},
                                             {"--hatch", "--hatch-spacing", "6px"},
                                             {"--cut-light", "keep"},
                                             {"--aperture", "0.4"},
                                             {"--aperture", "0.4", "--focus", "1"},
                                             {"--aperture", "0.4", "--focus", "1,0,0.5"}}) {
    different.insert(picture(words));
  }
  EXPECT_EQ(different.size(), 9u);
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"--hatch-spacing", "0", "--hatch"},
                                             {"--hatch-spacing", "px", "--hatch"},
                                             {"--hatch-spacing", "-3px", "--hatch"},
                                             {"--hatch-spacing", "3"},
                                             {"--cut-light", "on"},
                                             {"--cut-faces", "both"},
                                             {"--aperture", "-1"},
                                             {"--focus", "1,2"},
                                             {"--view", "1"},
                                             {"--view", "0,91"}}) {
    std::vector<std::string> all{"render", "ball.scad", "-q"};
    all.insert(all.end(), wrong.begin(), wrong.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.status, 2) << wrong[0] << ' ' << wrong[1];
    EXPECT_TRUE(contains(outcome.err, wrong[0])) << outcome.err;
  }
}

// What a scene decides: with a cut or a lens of its own there is nothing to warn of.
TEST_F(RenderCommand, ArgumentsThatDoNothingAreToldSo) {
  write("plain.scad", "sphere(1);");
  write("cut.scad", "section([0, -1, 0]); camera(from = [0, -9, 0], at = [0, 0, 0], aperture = 0.1); sphere(1);");
  for (const auto& [word, value] : {std::pair("--hatch", ""), {"--cut-light", "keep"}, {"--focus", "5"}}) {
    for (const std::string scene : {"plain.scad", "cut.scad"}) {
      std::vector<std::string> words{"render", scene, "-q", "--size", "8x6", "-o", "x.png", word};
      if (*value != 0) words.emplace_back(value);
      const Outcome outcome = run(words);
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_EQ(contains(outcome.err, std::string("warning: ") + word), scene == "plain.scad") << outcome.err;
      EXPECT_EQ(contains(outcome.err, "does nothing"), scene == "plain.scad") << outcome.err;
    }
  }
}

// In a closed room that returns 19 of 20 parts of the light, 0.95^20 of it takes more than 20 surfaces, and 0.95^200
// cannot be seen.
TEST_F(RenderCommand, LightThatTheDepthCutsIsTold) {
  write("room.scad",
        "camera(from = [0, -4, 0], at = [0, 0, 0]); light(type = \"sphere\", position = [0, 0, 3], radius = 0.5);\n"
        "material(\"white\", model = \"lambert\", color = [0.977, 0.977, 0.977])\n"
        "difference() { cube(12, center = true); cube(10, center = true); }\n");
  const auto errors = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"render",       "room.scad", "-q", "--size", "16x12",   "--spp", "16",
                                   "--integrator", "path",      "-o", "x.png",  "--stats", "s.json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words).err;
  };
  EXPECT_TRUE(contains(errors({}), "warning: paths of more than 20 surfaces would bring ")) << errors({});
  const Json json = Json::parse(read("s.json"));
  EXPECT_NEAR(json["share_cut"].get<double>(), std::pow(0.95, 20), 0.05);
  EXPECT_GT(json["paths_cut"].get<int>(), 0);
  EXPECT_EQ(errors({"--depth", "200"}), "");
  EXPECT_EQ(errors({"--depth", "5"}), "") << "a choice";
  // Within a block of glass total reflection keeps half of all paths for ever, and no light comes along them.
  write("room.scad",
        "camera(from = [0.2, 0.1, 0], at = [1, 0.3, 0.2], fov = 80); light(type = \"environment\");\n"
        "material(\"a\", model = \"dielectric\", ior = 1.7) cube(3, center = true);\n");
  EXPECT_EQ(errors({}), "");
  EXPECT_GT(Json::parse(read("s.json"))["paths_cut"].get<int>(), 0);
}

TEST_F(RenderCommand, MetadataIsAsItWasGiven) {
  ASSERT_EQ(run({"render", "ball.scad", "-q", "--size", "8x6", "--noise", "0.05", "-o", "x.png"}).status, 0);
  EXPECT_TRUE(contains(read("x.png"), " --noise 0.05")) << read("x.png");
  EXPECT_FALSE(contains(read("x.png"), "0.0500"));
}

TEST_F(RenderCommand, FitFillsThePictureWhateverItsShape) {
  for (const std::string size : {"80x80", "120x80", "80x120"}) {
    ASSERT_EQ(run({"render", "ball.scad", "-q", "--size", size, "--view", "20,10", "--fit", "--ortho"}).status, 0);
    const Picture picture = decode(read("ball.png"));
    const auto background = picture.at(0, 0);
    int left = picture.width, right = -1, top = picture.height, bottom = -1;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (picture.at(x, y) == background) continue;
        left = std::min(left, x), right = std::max(right, x), top = std::min(top, y), bottom = std::max(bottom, y);
      }
    }
    // 2.5 % of 80 pixels are free on both sides, and up to one that the solid only touches.
    const int free_x = std::max(left, picture.width - 1 - right), free_y = std::max(top, picture.height - 1 - bottom);
    EXPECT_LE(std::min(free_x, free_y), 3) << size;
    EXPECT_GE(std::min({left, picture.width - 1 - right, top, picture.height - 1 - bottom}), 2) << size;
  }
}

TEST_F(RenderCommand, DefinitionsReachTheScene) {
  write("sized.scad", "r = 1; camera(from = [0, -10, 0], at = [0, 0, 0], fov = 40); sphere(r);");
  ASSERT_EQ(run({"render", "sized.scad", "-q", "--size", "40x40", "-o", "small.png"}).status, 0);
  ASSERT_EQ(run({"render", "sized.scad", "-q", "--size", "40x40", "-D", "r=3", "-o", "large.png"}).status, 0);
  const Picture small = decode(read("small.png")), large = decode(read("large.png"));
  EXPECT_EQ(small.at(7, 20), small.at(0, 0));
  EXPECT_NE(large.at(7, 20), large.at(0, 0));
}

TEST_F(RenderCommand, StatisticsHaveTheirNames) {
  ASSERT_EQ(run({"render", "ball.scad", "-q", "--size", "32x24", "--spp", "2", "--stats", "s.json"}).status, 0);
  const Json json = Json::parse(read("s.json"));
  for (const char* name : {"accel", "threads", "build_seconds", "memory_bytes", "render_seconds", "rays",
                           "rays_per_second", "primitive_tests", "cells_visited", "next_box_calls", "mailbox_hits",
                           "boxes", "depth", "mismatches", "seam_faults", "per_kind", "paths_cut", "share_cut"}) {
    EXPECT_TRUE(json.contains(name)) << name;
  }
  EXPECT_EQ(json["rays"]["primary"], 32 * 24 * 2);
  EXPECT_EQ(json["seam_faults"], 0);
  std::uint64_t tests = 0;
  for (const char* kind : {"primary", "shadow", "reflected", "refracted", "diffuse"}) {
    tests += json["per_kind"][kind]["primitive_tests"].get<std::uint64_t>();
  }
  EXPECT_EQ(json["primitive_tests"], tests);
}

// Where the boxes of all primitives overlap, cells are cut around the surface itself (the thesis's grooved sphere,
// §4.3, on which the OKD-tree has one leaf).
TEST_F(RenderCommand, CellsTestFewOfThePrimitivesWhoseBoxesOverlap) {
  const auto tests_per_ray = [&](const std::string& accelerator) {
    const std::string scene = std::string(TENON_ROOT) + "/scenes/bench/bare_grooved_sphere.scad";
    const Outcome outcome = run({"render", scene, "-q", "--accel", accelerator, "--size", "320x240", "--spp", "1", "-o",
                                 "grooved.png", "--stats", "s.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const Json primary = Json::parse(read("s.json"))["per_kind"]["primary"];
    return primary["primitive_tests"].get<double>() / (320 * 240);
  };
  EXPECT_LT(tests_per_ray("cells"), 1.3);
  EXPECT_GT(tests_per_ray("okd"), 4);
}

// Each scene that is wrong, and what the message must hold.
TEST_F(RenderCommand, WrongScenesLeaveNothing) {
  write("empty.scad", "");
  write("syntax.scad", "sphere(1);\ncube(2;\n");
  write("dark.scad", "light(type = \"environment\",\n  file = \"broken.hdr\"); sphere(1);\n");
  write("broken.hdr", "no picture");
  write("junk.scad", std::string("\x7f"
                                 "ELF\x02\x01\x00\x00\xff\xfe\x80",
                                 11) +
                         std::string(5000, '\xaa'));
  std::filesystem::create_directory(folder / "folder.scad");
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"missing.scad", "missing.scad"},  {"folder.scad", "folder.scad"},          {"empty.scad", "solid"},
      {"syntax.scad", "syntax.scad:2:"}, {"dark.scad", "dark.scad:2:3: error: "}, {"junk.scad", "junk.scad"}};
  const std::size_t before = files();
  for (const auto& [scene, part] : wrong) {
    const Outcome outcome = run({"render", scene, "-o", "out.png", "--stats", "s.json", "-q"});
    EXPECT_EQ(outcome.status, 1) << scene << ": " << outcome.err;
    EXPECT_TRUE(contains(outcome.err, part)) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "error: ")) << outcome.err;
    EXPECT_EQ(files(), before) << scene;
  }
}

TEST_F(RenderCommand, OldPictureStaysWhenTheSceneIsWrong) {
  write("out.png", "old");
  write("bad.scad", "cube(");
  EXPECT_EQ(run({"render", "bad.scad", "-o", "out.png"}).status, 1);
  EXPECT_EQ(read("out.png"), "old");
}

TEST_F(RenderCommand, PlacesThatCannotBeWritten) {
  const std::size_t before = files();
  for (const std::string place : {"no/such/folder.png", "/proc/x.png"}) {
    const Outcome outcome = run({"render", "ball.scad", "-q", "--size", "8x8", "-o", place});
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, place)) << outcome.err;
  }
  EXPECT_EQ(run({"render", "ball.scad", "-q", "--size", "8x8", "-o", "x.png", "--stats", "no/such/s.json"}).status, 3);
  EXPECT_EQ(files(), before);
}

TEST_F(RenderCommand, FullDeviceIsAMachineError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  const Outcome outcome = run({"render", "ball.scad", "-q", "--size", "8x8", "-o", "/dev/full"});
  EXPECT_EQ(outcome.status, 3);
  EXPECT_TRUE(contains(outcome.err, "'/dev/full'")) << outcome.err;
}

TEST_F(RenderCommand, FullDiskLeavesTheOldPicture) {
  write("out.png", "old");
  // The limit on the size of files stands for a full disk; the program inherits it.
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit limited{512, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limited);
  const pid_t child = start({"render", "ball.scad", "-q", "--size", "200x200", "-o", "out.png"});
  setrlimit(RLIMIT_FSIZE, &old);
  const Outcome outcome = wait_for(child);
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "out.png")) << outcome.err;
  EXPECT_EQ(read("out.png"), "old");
  EXPECT_EQ(files(), 2U);
}

TEST_F(RenderCommand, InterruptKeepsWhatIsThereAndEndsWith130) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const pid_t child = start({"render", "ball.scad", "--size", "400x300", "--spp", "100000", "-o", "out.png"});
    for (int i = 0; i < 500 && !contains(read(".stream-err"), "rendering"); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    kill(child, signal);
    const Outcome outcome = wait_for(child);
    EXPECT_EQ(outcome.status, 128 + signal);
    EXPECT_TRUE(contains(outcome.err, "interrupted, with ")) << outcome.err;
    const Picture picture = decode(read("out.png"));
    EXPECT_EQ(picture.width, 400);
    EXPECT_NE(picture.at(200, 150), picture.at(0, 0));
    EXPECT_EQ(files(), 2U);
  }
}

TEST_F(RenderCommand, InterruptBeforeThereIsAnythingLeavesNothing) {
  write("long.scad", "function f(n) = n < 2 ? n : f(n - 1) + f(n - 2); sphere(f(50));");
  const pid_t child = start({"render", "long.scad", "-q", "-o", "out.png"});
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  kill(child, SIGINT);
  EXPECT_EQ(wait_for(child).status, 130);
  EXPECT_EQ(files(), 2U);
}

TEST_F(RenderCommand, LongWorkSaysHowFarItIsUnlessQuiet) {
  std::vector<std::string> words{"render", "ball.scad", "--size", "2000x2000", "--spp", "64", "-o", "out.png"};
  for (const bool quiet : {false, true}) {
    if (quiet) words.push_back("--quiet");
    const pid_t child = start(words);
    for (int i = 0; i < (quiet ? 80 : 1000) && !contains(read(".stream-err"), "rays/s"); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    kill(child, SIGKILL);
    const Outcome outcome = wait_for(child);
    if (quiet) {
      EXPECT_EQ(outcome.err, "");
    } else {
      EXPECT_TRUE(contains(outcome.err, "tenon: rendering ")) << outcome.err;
      EXPECT_TRUE(contains(outcome.err, "rays/s")) << outcome.err;
    }
  }
}

}  // namespace
}  // namespace tenon
