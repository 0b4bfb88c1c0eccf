#include "render/pixel_samples.h"

#include <gtest/gtest.h>

#include <set>

namespace tenon {
namespace {

TEST(PixelSamples, OneIsTheCentre) {
  EXPECT_EQ(pixel_sample(0, 1).x, 0.5);
  EXPECT_EQ(pixel_sample(0, 1).y, 0.5);
}

TEST(PixelSamples, EachColumnAndRowHoldsOne) {
  for (std::uint32_t n : {2U, 4U, 16U, 64U}) {
    std::set<int> columns, rows;
    for (std::uint32_t i = 0; i < n; ++i) {
      const PixelSample s = pixel_sample(i, n);
      columns.insert(static_cast<int>(s.x * n));
      rows.insert(static_cast<int>(s.y * n));
    }
    EXPECT_EQ(columns.size(), n);
    EXPECT_EQ(rows.size(), n);
  }
}

TEST(PixelSamples, InsideThePixelForAnyNumber) {
  for (std::uint32_t n : {3U, 5U, 7U, 100U, 65536U}) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const PixelSample s = pixel_sample(i, n);
      EXPECT_TRUE(s.x > 0 && s.x < 1 && s.y > 0 && s.y < 1);
    }
  }
}

}  // namespace
}  // namespace tenon
