#include "tenon/render/progress.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <thread>

namespace tenon {
namespace {

TEST(ProgressText, SaysShareRateAndTimeLeft) {
  EXPECT_EQ(progress_text({"rendering", 100, 25, 3000000, 2}, false), "rendering  25 %  1.5 Mrays/s, 0:06 left");
  EXPECT_EQ(progress_text({"rendering", 100, 50, 0, 3661 * 2}, true),
            "rendering  50 % [############............], 2:02:02 left");
  EXPECT_EQ(progress_text({"rendering", 100, 0, 0, 5}, false), "rendering   0 %");
}

TEST(ProgressText, TimeLeftFollowsFromThisRunAlone) {
  // Half was there when the work began: 10 % in 5 s, 40 % are left.
  EXPECT_EQ(progress_text({"rendering", 100, 60, 0, 5, 50}, false), "rendering  60 %, 0:20 left");
}

TEST(ProgressText, EndsWithTheTimeAllowed) {
  EXPECT_EQ(progress_text({"rendering", 1000000, 10, 0, 6, 0, 30}, false), "rendering  20 %, 0:24 left");
  EXPECT_EQ(progress_text({"rendering", 100, 80, 0, 20, 0, 30}, false), "rendering  80 %, 0:05 left");
  EXPECT_EQ(progress_text({"rendering", 100, 0, 0, 31, 0, 30}, false), "rendering 100 %, 0:00 left");
}

TEST(ProgressText, WithoutATotalSaysTheTime) {
  EXPECT_EQ(progress_text({"reading x.scad", 0, 0, 0, 61.5}, true), "reading x.scad, 1:02");
}

std::string shown(ProgressStyle style) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  {
    ProgressDisplay display(out, style);
    display.begin("rendering");
    display.counters().total = 10;
    display.counters().done = 5;
    std::this_thread::sleep_for(std::chrono::milliseconds(1300));
    display.say("a warning");
    display.end();
  }
  std::fclose(out);
  std::string result(text, size);
  std::free(text);  // NOLINT: open_memstream's
  return result;
}

TEST(ProgressDisplay, SilentSaysOnlyWhatItIsTold) {
  EXPECT_EQ(shown(ProgressStyle::silent), "a warning\n");
}

TEST(ProgressDisplay, LinesForALog) {
  const std::string text = shown(ProgressStyle::lines);
  EXPECT_EQ(text.find("tenon: rendering  50 %"), 0U) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_NE(text.find("left\na warning\n"), std::string::npos);
}

TEST(ProgressDisplay, BarIsTakenAwayBeforeALine) {
  const std::string text = shown(ProgressStyle::bar);
  EXPECT_EQ(text.find("\rrendering  50 % ["), 0U) << text;
  EXPECT_NE(text.find(" \ra warning\n"), std::string::npos) << text;
}

TEST(ProgressDisplay, NothingForWorkDoneAtOnce) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* out = open_memstream(&text, &size);
  {
    ProgressDisplay display(out, ProgressStyle::lines);
    for (int i = 0; i < 100; ++i) display.begin("a thing");
  }
  std::fclose(out);
  EXPECT_EQ(size, 0U);
  std::free(text);  // NOLINT: open_memstream's
}

}  // namespace
}  // namespace tenon
