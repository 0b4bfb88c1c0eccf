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

TEST_F(Animation, ResumeTakesWhatIsNotThere) {
  for (const std::string suffix : {".png", ".exr"}) {
    const auto frame = [&](int i) { return "turn0000" + std::to_string(i) + suffix; };
    const std::vector<std::string> animate{"--animate", "5", "-o", "turn" + suffix};
    ASSERT_EQ(run(words(animate)).status, 0);
    std::vector<std::string> whole;
    for (int i = 0; i < 5; ++i) whole.push_back(read(frame(i)));
    write(frame(1), "foreign");
    write(frame(2), whole[2].substr(0, whole[2].size() * 2 / 3));
    std::filesystem::remove(folder / frame(3));
    write(frame(4), whole[0]);
    const auto first_written = std::filesystem::last_write_time(folder / frame(0));
    const Outcome outcome =
        run({"render", "turn.scad", "--size", "40x30", "--animate", "5", "-o", "turn" + suffix, "--resume"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (int i = 0; i < 5; ++i) {
      EXPECT_EQ(read(frame(i)), whole[static_cast<std::size_t>(i)]) << i;
      const bool is_told = contains(outcome.err, "warning: '" + frame(i) + "'");
      EXPECT_EQ(is_told, i == 1 || i == 2 || i == 4) << outcome.err;
    }
    EXPECT_EQ(std::filesystem::last_write_time(folder / frame(0)), first_written);
    EXPECT_TRUE(contains(outcome.err, "1 of 5 frames were there")) << outcome.err;
  }
}

TEST_F(Animation, ResumeTakesFramesOfOtherArgumentsAgain) {
  ASSERT_EQ(run(words({"--animate", "2"})).status, 0);
  for (const std::vector<std::string>& other : std::vector<std::vector<std::string>>{
           {"--crop", "0,0,20,30"}, {"--depth", "3"}, {"--spp", "2"}, {"-D", "x=1"}}) {
    std::vector<std::string> more{"--animate", "2", "--resume"};
    more.insert(more.end(), other.begin(), other.end());
    const Outcome outcome = run(words(more));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "'turn00001.png' is of another scene or other arguments")) << outcome.err;
    EXPECT_EQ(run(words(more)).err, "") << "they are there now";
  }
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
