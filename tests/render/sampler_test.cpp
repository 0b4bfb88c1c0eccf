#include "render/sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace tenon {
namespace {

TEST(SobolPoint, IsTheSumOfItsDirectionNumbers) {
  std::vector<std::uint32_t> v{1U << 31};
  while (v.size() < 32) v.push_back(v.back() ^ (v.back() >> 1));
  for (std::uint32_t i : {0U, 1U, 2U, 3U, 5U, 0x80000000U, 0xdeadbeefU, 0xffffffffU}) {
    SobolPoint expected;
    for (std::uint32_t k = 0; k < 32; ++k) {
      if ((i >> k & 1U) == 0) continue;
      expected.u ^= 1U << (31 - k);
      expected.v ^= v[k];
    }
    EXPECT_EQ(sobol_point(i).u, expected.u) << i;
    EXPECT_EQ(sobol_point(i).v, expected.v) << i;
  }
}

// Every box of width 2^-a and height 2^-(k-a) holds one point of each aligned block of 2^k.
TEST(Sampler, BlocksOfAPowerOfTwoAreNets) {
  const Sampler sampler(7);
  constexpr std::uint32_t k = 6, n = 1U << k;
  for (std::uint32_t pair : {0U, 1U, 17U}) {
    for (std::uint32_t begin : {0U, n, 5 * n}) {
      for (std::uint32_t a = 0; a <= k; ++a) {
        std::set<std::pair<int, int>> boxes;
        for (std::uint32_t i = begin; i < begin + n; ++i) {
          const Sample2 s = sampler({3, 4, i}, pair);
          ASSERT_GT(std::min(s.u, s.v), 0);
          ASSERT_LT(std::max(s.u, s.v), 1);
          boxes.insert({static_cast<int>(std::ldexp(s.u, static_cast<int>(a))),
                        static_cast<int>(std::ldexp(s.v, static_cast<int>(k - a)))});
        }
        EXPECT_EQ(boxes.size(), n) << "pair " << pair << ", from " << begin << ", columns 2^" << a;
      }
    }
  }
}

TEST(Sampler, WhatIsDrawnWithOthersIsWhatIsDrawnAlone) {
  const Sampler sampler(5);
  // More than are ever made together, and not a multiple of any vector's lanes.
  std::vector<SampleId> samples;
  for (int i = 0; i < 333; ++i) samples.push_back({7 * i, 1000 - i, static_cast<std::uint32_t>(i * i)});
  std::vector<Sample2> together(samples.size());
  sampler.draw(samples, 11, together);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample2 alone = sampler(samples[i], 11);
    EXPECT_EQ(together[i].u, alone.u) << i;
    EXPECT_EQ(together[i].v, alone.v) << i;
  }
}

// Pairs, pixels and seeds must not know of each other: the correlation of n independent pairs of numbers has a standard
// deviation of 1/sqrt(n); 6 of them are exceeded by one correlation in 5e8.
TEST(Sampler, PairsPixelsAndSeedsAreIndependent) {
  constexpr int n = 1 << 12;
  const auto correlation = [&](auto first, auto second) {
    double sum = 0;
    for (int i = 0; i < n; ++i) sum += (first(i) - 0.5) * (second(i) - 0.5);
    return 12 * sum / n;
  };
  const Sampler a(1), b(2);
  const double limit = 6 / std::sqrt(static_cast<double>(n));
  // Over pixels at one index, since points over the indices of one pixel are stratified on purpose.
  const auto at = [](const Sampler& sampler, std::uint32_t pair, int shift) {
    return [&sampler, pair, shift](int i) { return sampler({i % 64 + shift, i / 64, 3}, pair).u; };
  };
  EXPECT_LT(std::fabs(correlation(at(a, 0, 0), at(a, 1, 0))), limit);
  EXPECT_LT(std::fabs(correlation(at(a, 0, 0), at(a, 0, 1))), limit);
  EXPECT_LT(std::fabs(correlation(at(a, 0, 0), at(b, 0, 0))), limit);
  EXPECT_LT(std::fabs(correlation(
                [&](int i) {
                  return a({i % 64, i / 64, 3}, 0).u;
                },
                [&](int i) {
                  return a({i % 64, i / 64, 3}, 0).v;
                })),
            limit);
  // The order of the points differs from pair to pair, or a path's choices would be correlated.
  double same = 0;
  for (std::uint32_t i = 0; i < 256; ++i) {
    same += (a({0, 0, i}, 0).u - 0.5) * (a({0, 0, i}, 1).u - 0.5);
  }
  EXPECT_LT(std::fabs(12 * same / 256), 6.0 / 16);
}

}  // namespace
}  // namespace tenon
