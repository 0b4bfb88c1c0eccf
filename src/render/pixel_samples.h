#pragma once

#include <bit>
#include <cstdint>

namespace tenon {

/// A place in a pixel; both in (0, 1).
struct PixelSample {
  double x = 0.5, y = 0.5;
};

/// The i-th of n places: Sobol's first two dimensions (Sobol 1967), of which every power of two from the start fills
/// the pixel evenly, so that the first samples make a picture of their own; centred, so that a single sample is the
/// pixel's centre. All pixels share the pattern: straight edges stay clean, and nothing depends on tiles or threads.
inline PixelSample pixel_sample(std::uint32_t i, std::uint32_t n) {
  std::uint32_t x = 0, y = 0;
  // The direction numbers of the second dimension: v0 = 2^31, v_k+1 = v_k xor v_k / 2.
  std::uint32_t direction = 1U << 31U;
  for (std::uint32_t bit = 0; bit < 32; ++bit) {
    if ((i >> bit & 1U) != 0) x |= 1U << (31U - bit), y ^= direction;
    direction ^= direction >> 1U;
  }
  const double half_cell = 0.5 / static_cast<double>(std::bit_ceil(n));
  return {x * 0x1p-32 + half_cell, y * 0x1p-32 + half_cell};
}

}  // namespace tenon
