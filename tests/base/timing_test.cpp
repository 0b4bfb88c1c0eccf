#include "tenon/base/timing.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(Timing, MedianIsTheMiddle) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({7}), 7);
}

TEST(Timing, SpreadLeavesOutTheEndsFromFiveRoundsOn) {
  EXPECT_EQ((Timing{"", {2, 1, 3}}.spread()), 0.5);
  EXPECT_EQ((Timing{"", {10, 9, 11, 0, 100}}.spread()), 0.1);
  EXPECT_EQ((Timing{"", {5}}.spread()), 0);
}

TEST(Timing, RatioIsOfTheSameRound) {
  // The machine was ten times slower in the second round; the ratio does not see it.
  EXPECT_EQ(ratio({"", {2, 20, 2.2}}, {"", {1, 10, 1.1}}), 2);
}

TEST(Timing, ContendersTakeTurns) {
  std::string order;
  const std::vector<Timing> timings = take_turns({"a", "b"}, 2, [&](std::size_t i) {
    order += static_cast<char>('a' + i);
    return static_cast<double>(order.size());
  });
  EXPECT_EQ(order, "ababab");
  ASSERT_EQ(timings.size(), 2U);
  EXPECT_EQ(timings[1].name, "b");
  EXPECT_EQ(timings[1].seconds, (std::vector<double>{4, 6}));
}

}  // namespace
}  // namespace tenon
