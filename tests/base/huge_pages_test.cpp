#include "tenon/base/huge_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace tenon {
namespace {

struct alignas(64) Line {
  std::uint64_t value;
};

// Below a page, at its size, and across several; what is added moves with the vector.
TEST(HugePages, HoldWhatAVectorHolds) {
  constexpr std::size_t lines_a_page = (std::size_t{1} << 21) / sizeof(Line);
  HugePageVector<Line> lines;
  for (std::uint64_t i = 0; i < 3 * lines_a_page + 5; ++i) lines.push_back({i});
  for (std::uint64_t i = 0; i < lines.size(); ++i) ASSERT_EQ(lines[i].value, i);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % (std::size_t{1} << 21), 0u);

  lines.resize(3);
  lines.shrink_to_fit();
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % alignof(Line), 0u);
  EXPECT_EQ(lines[2].value, 2u);
  HugePageVector<char> small(7, 'a');
  EXPECT_EQ(std::accumulate(small.begin(), small.end(), 0), 7 * 'a');
}

}  // namespace
}  // namespace tenon
