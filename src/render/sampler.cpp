#include "render/sampler.h"

namespace tenon {

namespace {

std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffU) << 8) | ((x >> 8) & 0x00ff00ffU);
  x = ((x & 0x0f0f0f0fU) << 4) | ((x >> 4) & 0x0f0f0f0fU);
  x = ((x & 0x33333333U) << 2) | ((x >> 2) & 0x33333333U);
  return ((x & 0x55555555U) << 1) | ((x >> 1) & 0x55555555U);
}

// A permutation in which each bit depends on the lower ones alone (Laine and Karras, with Burley's constants).
std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x += seed;
  x ^= x * 0x6c50b47cU;
  x ^= x * 0xb82f1e52U;
  x ^= x * 0xc7afe638U;
  x ^= x * 0x8d22f6e6U;
  return x;
}

// The product with Pascal's upper triangular matrix mod 2, whose quarters are itself, itself, zero and itself again:
// the bits of v in the order of their weight from the lowest.
std::uint32_t pascal(std::uint32_t i) {
  i ^= i >> 16;
  i ^= (i & 0xff00ff00U) >> 8;
  i ^= (i & 0xf0f0f0f0U) >> 4;
  i ^= (i & 0xccccccccU) >> 2;
  return i ^ ((i & 0xaaaaaaaaU) >> 1);
}

// SplitMix64's finalizer (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

double fraction(std::uint32_t bits) {
  return (bits + 0.5) * 0x1p-32;
}

}  // namespace

SobolPoint sobol_point(std::uint32_t i) {
  return {reverse_bits(i), reverse_bits(pascal(i))};
}

Sample2 Sampler::operator()(const SampleId& sample, std::uint32_t pair) const {
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ULL;
  const std::uint64_t pixel =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(sample.y)) << 32 | static_cast<std::uint32_t>(sample.x);
  const std::uint64_t order = mix(mix(pixel + golden * seed_) + golden * (pair + 1));
  const std::uint64_t digits = mix(order + golden);
  // Scrambling works on reversed bits. The index comes as it is, and its scrambled value is wanted reversed twice.
  const std::uint32_t i = reverse_bits(laine_karras(reverse_bits(sample.index), static_cast<std::uint32_t>(order)));
  return {fraction(reverse_bits(laine_karras(i, static_cast<std::uint32_t>(digits)))),
          fraction(reverse_bits(laine_karras(pascal(i), static_cast<std::uint32_t>(digits >> 32))))};
}

}  // namespace tenon
