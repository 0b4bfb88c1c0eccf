// Pictures that are taken in parts, broken off and taken up again.

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include "apps/program_test.h"
#include "support/random.h"

namespace tenon {
namespace {

using Words = std::vector<std::string>;

class LongWork : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("ball.scad",
          "difference() { sphere(1); translate([0, 0, 1]) cube(1, center = true); }\n"
          "material(\"glass\") translate([0.9, -1.2, -0.4]) sphere(0.5);\n");
  }

  static Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  Words render(const Words& more) const {
    return joined({"render", "ball.scad", "-q", "--size", "61x47", "--integrator", "path", "--spp", "6"}, more);
  }
  void expect_done(const Words& words) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
};

TEST_F(LongWork, MergeOfSlicesAndCropsIsTheSingleRun) {
  const std::uint64_t seed = 8;
  SCOPED_TRACE(seed);
  Random random(seed);
  expect_done(render({"-o", "single.exr", "--layers", "all"}));
  expect_done(render({"-o", "single.png", "--bits", "16"}));
  for (int round = 0; round < 3; ++round) {
    Words parts;
    const std::string x = std::to_string(1 + random.below(60)), b = std::to_string(1 + random.below(5));
    for (const std::string& crop : {"0,0," + x + ",47", x + ",0,61,47"}) {
      for (const std::string& samples : {"0:" + b, b + ":6"}) {
        parts.push_back(std::to_string(parts.size()) + ".exr");
        expect_done(render({"-o", parts.back(), "--layers", "all", "--crop", crop, "--samples", samples}));
      }
    }
    for (std::size_t i = parts.size(); i-- > 1;) std::swap(parts[i], parts[random.bits() % (i + 1)]);
    expect_done(joined({"merge", "-q", "-o", "merged.exr"}, parts));
    EXPECT_EQ(read("merged.exr"), read("single.exr")) << x << ' ' << b;
    expect_done(joined({"merge", "-q", "-o", "merged.png", "--bits", "16"}, parts));
    EXPECT_EQ(read("merged.png"), read("single.png")) << x << ' ' << b;
    // Three of them are one part.
    expect_done({"merge", "-q", "-o", "three.exr", parts[0], parts[1], parts[2]});
    expect_done({"merge", "-q", "-o", "merged.exr", "three.exr", parts[3]});
    EXPECT_EQ(read("merged.exr"), read("single.exr")) << x << ' ' << b;
  }
}

TEST_F(LongWork, MergeRefusesWhatDoesNotBelongTogether) {
  expect_done(render({"-o", "a.exr", "--samples", "0:3"}));
  expect_done(render({"-o", "b.exr", "--samples", "2:6"}));
  expect_done(render({"-o", "c.exr", "--samples", "3:6", "--seed", "7"}));
  expect_done(render({"-o", "plain.exr"}));
  write("no.exr", "not a picture");
  const std::vector<std::pair<std::string, std::string>> wrong{{"b.exr", "hold the same samples"},
                                                               {"c.exr", "Seed '7', not '0'"},
                                                               {"plain.exr", "--layers sums"},
                                                               {"no.exr", "no EXR picture"},
                                                               {"missing.exr", "No such file"}};
  for (const auto& [other, part] : wrong) {
    const Outcome outcome = run({"merge", "-o", "x.png", "a.exr", other});
    EXPECT_EQ(outcome.status, 1) << other;
    EXPECT_TRUE(contains(outcome.err, part)) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
  }
}

TEST_F(LongWork, PartSaysHowMuchIsThere) {
  expect_done(render({"-o", "a.exr", "--samples", "0:3"}));
  const Outcome outcome = run({"merge", "a.exr", "-o", "x.png"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_TRUE(contains(outcome.err, "50.0 %")) << outcome.err;
}

TEST_F(LongWork, PictureSaysHowManySamplesItHas) {
  const auto says = [&](const std::string& name, const std::string& text) { return contains(read(name), text); };
  expect_done(render({"-o", "a.png", "--samples", "0:3"}));
  EXPECT_TRUE(says("a.png", "3.0 of 6 a pixel"));
  expect_done(render({"-o", "a.exr", "--samples", "0:3"}));
  EXPECT_TRUE(says("a.exr", "3.0 of 6 a pixel"));
  expect_done(render({"-o", "b.exr", "--samples", "3:6"}));
  for (const std::string name : {"all.exr", "all.png"}) {
    expect_done({"merge", "-q", "-o", name, "a.exr", "b.exr"});
    EXPECT_TRUE(says(name, "6 a pixel")) << name;
  }
  expect_done({"render", "ball.scad", "-q", "--size", "200x150", "--time", "0.2", "-o", "time.png"});
  EXPECT_TRUE(says("time.png", " of 65536 a pixel"));
}

TEST_F(LongWork, TimeMayEndBeforeNoiseIsKnown) {
  const Outcome outcome = run({"render", "ball.scad", "-q", "--size", "200x150", "--integrator", "path", "--time",
                               "0.001", "--denoise", "-o", "out.png"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "no pixel has more than one sample yet")) << outcome.err;
  EXPECT_EQ(read("out.png").substr(0, 4), "\x89PNG");
}

TEST_F(LongWork, MergeSeesThatTheLightHasChanged) {
  write("ball.scad", "light(type = \"environment\", file = \"sky.exr\"); sphere(1);\n");
  write("floor.scad", "camera(from = [0, -3, 3], at = [0, 0, 0]); cube(1);\n");
  for (const std::string part : {"a", "b"}) {
    expect_done(
        {"render", "floor.scad", "-q", "--size", part == "a" ? "8x4" : "16x8", "--layers", "none", "-o", "sky.exr"});
    expect_done(render({"-o", part + ".exr", "--samples", part == "a" ? "0:3" : "3:6"}));
  }
  const Outcome outcome = run({"merge", "a.exr", "b.exr", "-o", "x.png"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.err, "of another picture")) << outcome.err;
}

TEST_F(LongWork, MergeSeesThatAMeshHasChanged) {
  const auto tetrahedron = [&](const std::string& top) {
    const std::string a = "0 0 0", b = "1 0 0", c = "0 1 0", d = "0 0 " + top;
    std::string text = "solid t\n";
    for (const auto& [p, q, r] : {std::array{a, c, b}, std::array{a, b, d}, std::array{a, d, c}, std::array{b, c, d}}) {
      text +=
          "facet normal 0 0 0\nouter loop\nvertex " + p + "\nvertex " + q + "\nvertex " + r + "\nendloop\nendfacet\n";
    }
    write("t.stl", text + "endsolid\n");
  };
  write("ball.scad", "camera(from = [3, 3, 3], at = [0, 0, 0]); import(\"t.stl\");\n");
  tetrahedron("1");
  expect_done(render({"-o", "a.exr", "--samples", "0:3"}));
  tetrahedron("2");
  expect_done(render({"-o", "b.exr", "--samples", "3:6"}));
  const Outcome outcome = run({"merge", "a.exr", "b.exr", "-o", "x.png"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.err, "of another picture")) << outcome.err;
}

// Kills the program without warning, again and again, somewhere in the middle.
TEST_F(LongWork, KilledAndResumedIsTheSameBytes) {
  for (const Words& more : {Words{}, Words{"--noise", "0.01", "--crop", "10,5,50,40"}}) {
    const Words words = joined(
        {"render", "ball.scad", "-q", "--size", "61x47", "--integrator", "path", "--spp", "400", "--seed", "3"}, more);
    expect_done(joined(words, {"-o", "single.exr"}));
    const Words resumed =
        joined(words, {"-o", "out.exr", "--checkpoint", "work.exr", "--checkpoint-every", "0.01", "--resume"});
    int kills = 0;
    Outcome outcome;
    std::string kept;
    for (int i = 0; i < 100 && outcome.status != 0; ++i) {
      const pid_t child = start(resumed);
      // Until there is a checkpoint that was not there before.
      while (waitpid(child, nullptr, WNOHANG) == 0 && kills < 5 && read("work.exr") == kept) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
      if (kills < 5 && kill(child, SIGKILL) == 0) ++kills;
      outcome = wait_for(child);
      kept = read("work.exr");
    }
    EXPECT_EQ(read("out.exr"), read("single.exr"));
    EXPECT_GE(kills, 2);
    EXPECT_FALSE(std::filesystem::exists(folder / "work.exr"));
  }
}

TEST_F(LongWork, ResumesWhatWasInterrupted) {
  const Words picture{"render", "ball.scad", "-q", "--size", "61x47", "--integrator", "path", "--spp", "300"};
  expect_done(joined(picture, {"-o", "single.png"}));
  const Words words = joined(picture, {"-o", "out.png", "--checkpoint", "work.exr", "--resume"});
  const pid_t child = start(words);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  kill(child, SIGINT);
  const Outcome first = wait_for(child);
  EXPECT_TRUE(first.status == 130 || first.status == 0) << first.err;
  expect_done(words);
  EXPECT_EQ(read("out.png"), read("single.png"));
}

TEST_F(LongWork, CheckpointOfAnotherPictureIsRefused) {
  expect_done(render({"-o", "work.exr", "--samples", "0:3"}));
  const std::string kept = read("work.exr");
  for (const Words& other : {Words{}, Words{"--samples", "3:6"}, Words{"--samples", "0:3", "--seed", "5"}}) {
    const Outcome outcome = run(joined(render({"-o", "x.exr", "--checkpoint", "work.exr", "--resume"}), other));
    // The first is no other picture but all of this one.
    EXPECT_EQ(outcome.status, other.empty() ? 0 : 1) << outcome.err;
    EXPECT_EQ(contains(outcome.err, "checkpoint of another picture"), !other.empty()) << outcome.err;
    write("work.exr", kept);
  }
}

TEST_F(LongWork, CheckpointThatFindsNoRoomIsAWarningAndTheOneBeforeStays) {
  const Words words{"render", "ball.scad", "-q", "--size", "200x150", "--spp", "4096"};
  ASSERT_EQ(run(joined(words, {"--samples", "0:1", "--layers", "none", "--bits", "32", "-o", "work.exr"})).status, 0);
  const std::string before = read("work.exr");
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit limited{20000, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limited);
  const pid_t child = start(joined(
      words, {"-o", "out.png", "--checkpoint", "work.exr", "--checkpoint-every", "0.01", "--resume", "--time", "2"}));
  setrlimit(RLIMIT_FSIZE, &old);
  const Outcome outcome = wait_for(child);
  const std::string warning = "the work goes on without checkpoints until this is mended";
  ASSERT_TRUE(contains(outcome.err, warning)) << outcome.err;
  EXPECT_FALSE(contains(outcome.err.substr(outcome.err.find(warning) + 1), warning)) << outcome.err;
  EXPECT_EQ(read("work.exr"), before);
}

TEST_F(LongWork, CheckpointThatIsThereIsNotWrittenOver) {
  write("work.exr", "hours of work");
  const Outcome outcome = run(render({"-o", "out.png", "--checkpoint", "work.exr"}));
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.err, "go on from it with --resume, or remove it")) << outcome.err;
  EXPECT_EQ(read("work.exr"), "hours of work");
  EXPECT_FALSE(std::filesystem::exists(folder / "out.png"));
}

TEST_F(LongWork, TimeIsABudget) {
  const auto begun = std::chrono::steady_clock::now();
  const Outcome outcome = run({"render", "ball.scad", "--size", "200x150", "--time", "0.3", "-o", "out.png"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "time is over, with ")) << outcome.err;
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(30));
  EXPECT_EQ(read("out.png").substr(0, 4), "\x89PNG");
}

}  // namespace
}  // namespace tenon
