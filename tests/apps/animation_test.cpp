#include <chrono>
#include <thread>

#include "apps/program_test.h"

namespace tenon {
namespace {

class Animation : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("turn.scad", "x = 4 * $t; camera(from = [0, -12, 0], at = [0, 0, 0]); translate([x - 2, 0, 0]) sphere(1);\n");
  }
  std::vector<std::string> words(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"render", "turn.scad", "-q", "--size", "40x30"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

TEST_F(Animation, FramesAreNumberedAndTimeGoesOn) {
  std::filesystem::create_directory(folder / "out");
  const Outcome outcome = run(words({"--animate", "4", "-o", "out/turn.png"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (int i = 0; i < 4; ++i) {
    const std::string t = std::to_string(i / 4.0);
    ASSERT_EQ(run(words({"-D", "$t=" + t.substr(0, t.find_last_not_of('0') + 1), "-o", "one.exr", "--layers", "none"}))
                  .status,
              0);
    ASSERT_EQ(run(words({"-D", "x=" + std::to_string(i), "-o", "same.png"})).status, 0);
    const std::string frame = read("out/turn0000" + std::to_string(i) + ".png"), same = read("same.png");
    // The pixels are those of x set by hand; what is said beside them differs.
    ASSERT_NE(frame.find("IDAT"), std::string::npos);
    EXPECT_EQ(frame.substr(frame.find("IDAT")), same.substr(same.find("IDAT"))) << i;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out/turn00004.png"));
}

TEST_F(Animation, ResumeLeavesFramesAloneThatAreThere) {
  ASSERT_EQ(run(words({"--animate", "3"})).status, 0);
  const std::string first = read("turn00000.png");
  write("turn00001.png", "mine");
  std::filesystem::remove(folder / "turn00002.png");
  ASSERT_EQ(run(words({"--animate", "3", "--resume"})).status, 0);
  EXPECT_EQ(read("turn00000.png"), first);
  EXPECT_EQ(read("turn00001.png"), "mine");
  EXPECT_EQ(read("turn00002.png").substr(0, 4), "\x89PNG");
}

TEST_F(Animation, InterruptLeavesNoFrameHalfDone) {
  const std::vector<std::string> line = words({"--spp", "60000", "--integrator", "path", "--animate", "2"});
  const pid_t child = start(line);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(child, SIGINT);
  const Outcome outcome = wait_for(child);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  EXPECT_EQ(files(), 1U);
}

}  // namespace
}  // namespace tenon
