#include "render/sampler.h"

#include <algorithm>
#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/sampler.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TENON_RENDER_SAMPLER_CPP_
#define TENON_RENDER_SAMPLER_CPP_
namespace tenon {
namespace {

constexpr std::size_t most_together = 64;

constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;

/// Samples whose pairs are made together.
struct SampleBlock {
  std::array<std::uint64_t, most_together> pixel;
  std::array<std::uint32_t, most_together> index;
  std::size_t count;
};
struct PairBlock {
  std::array<double, most_together> u, v;
};

inline std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffU) << 8) | ((x >> 8) & 0x00ff00ffU);
  x = ((x & 0x0f0f0f0fU) << 4) | ((x >> 4) & 0x0f0f0f0fU);
  x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
  return ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
}

// A permutation in which each bit depends on the lower ones alone (Laine and Karras, with Burley's constants).
inline std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cU;
  x ^= x * 0xb82f1e52U;
  x ^= x * 0xc7afe638U;
  x ^= x * 0x8d22f6e6U;
  return x;
}

// The product with Pascal's upper triangular matrix mod 2, whose quarters are itself, itself, zero and itself again:
// the bits of v in the order of their weight from the lowest.
inline std::uint32_t pascal(std::uint32_t i) {
  i ^= i >> 16;
  i ^= (i & 0xff00ff00U) >> 8;
  i ^= (i & 0xf0f0f0f0U) >> 4;
  i ^= (i & 0xccccccccU) >> 2;
  return i ^ ((i & 0xaaaaaaaaU) >> 1);
}

// SplitMix64's finalizer (Steele, Lea, Flood 2014).
inline std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

inline double fraction(std::uint32_t bits) {
  return (bits + 0.5) * 0x1p-32;
}

}  // namespace
}  // namespace tenon
#endif

// What follows is compiled for each instruction set, for the compiler to make vectors of.
HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

void DrawBlock(const SampleBlock& samples, std::uint64_t seed, std::uint32_t pair, PairBlock& pairs) {
  std::array<std::uint32_t, most_together> order, u, v;
  for (std::size_t i = 0; i < samples.count; ++i) {
    const std::uint64_t order_seed = mix(mix(samples.pixel[i] + golden * seed) + golden * (pair + 1));
    const std::uint64_t digits_seed = mix(order_seed + golden);
    order[i] = static_cast<std::uint32_t>(order_seed);
    u[i] = static_cast<std::uint32_t>(digits_seed);
    v[i] = static_cast<std::uint32_t>(digits_seed >> 32);
  }
  for (std::size_t i = 0; i < samples.count; ++i) {
    // Scrambling works on reversed bits. The index comes as it is, and its scrambled value is wanted reversed twice.
    const std::uint32_t point = reverse_bits(laine_karras(reverse_bits(samples.index[i]), order[i]));
    pairs.u[i] = fraction(reverse_bits(laine_karras(point, u[i])));
    pairs.v[i] = fraction(reverse_bits(laine_karras(pascal(point), v[i])));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(DrawBlock);

SobolPoint sobol_point(std::uint32_t i) {
  return {reverse_bits(i), reverse_bits(pascal(i))};
}

void Sampler::draw(std::span<const SampleId> samples, std::uint32_t pair, std::span<Sample2> pairs) const {
  SampleBlock together;
  PairBlock drawn;
  for (std::size_t begin = 0; begin < samples.size(); begin += most_together) {
    together.count = std::min(most_together, samples.size() - begin);
    for (std::size_t i = 0; i < together.count; ++i) {
      const SampleId& sample = samples[begin + i];
      together.pixel[i] =
          static_cast<std::uint64_t>(static_cast<std::uint32_t>(sample.y)) << 32 | static_cast<std::uint32_t>(sample.x);
      together.index[i] = sample.index;
    }
    HWY_DYNAMIC_DISPATCH(DrawBlock)(together, seed_, pair, drawn);
    for (std::size_t i = 0; i < together.count; ++i) pairs[begin + i] = {drawn.u[i], drawn.v[i]};
  }
}

}  // namespace tenon
#endif
