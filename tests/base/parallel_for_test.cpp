#include "tenon/base/parallel_for.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <vector>

namespace tenon {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
  for (int threads : {1, 2, 5}) {
    std::vector<std::atomic<int>> visits(1000);
    parallel_for(visits.size(), threads, [&](std::size_t index, int worker) {
      EXPECT_GE(worker, 0);
      EXPECT_LT(worker, threads);
      ++visits[index];
    });
    for (const auto& v : visits) EXPECT_EQ(v, 1);
  }
}

TEST(ParallelFor, WorkersNeverShareTheirNumber) {
  std::vector<std::atomic<int>> busy(4);
  parallel_for(2000, 4, [&](std::size_t, int worker) {
    const auto w = static_cast<std::size_t>(worker);
    EXPECT_EQ(busy[w].fetch_add(1), 0);
    busy[w].fetch_sub(1);
  });
}

TEST(ParallelFor, NothingToDo) {
  parallel_for(0, 3, [](std::size_t, int) { FAIL(); });
}

TEST(ParallelFor, ExceptionReachesTheCallerAndStopsTheWork) {
  std::atomic<int> begun{0};
  const auto body = [&](std::size_t index, int) {
    ++begun;
    if (index == 10) throw std::bad_alloc();
  };
  EXPECT_THROW(parallel_for(1000000, 2, body), std::bad_alloc);
  EXPECT_LT(begun, 1000000);
}

}  // namespace
}  // namespace tenon
