#pragma once

#include <bit>
#include <cstdint>

namespace tenon {

/// A place in a pixel; both in (0, 1).
struct PixelSample {
  double x = 0.5, y = 0.5;
};

/// The i-th of n places: Hammersley's points, centred, so that each of the n columns and of the rows holds one, and a
/// single sample is the pixel's centre. All pixels share the pattern: straight edges stay clean, and nothing depends on
/// tiles or threads.
inline PixelSample pixel_sample(std::uint32_t i, std::uint32_t n) {
  std::uint32_t reversed = 0;
  for (std::uint32_t bit = 0; bit < 32; ++bit) reversed |= ((i >> bit) & 1U) << (31U - bit);
  const double row = 1.0 / static_cast<double>(std::bit_ceil(n));
  return {(i + 0.5) / n, reversed * 0x1p-32 + 0.5 * row};
}

}  // namespace tenon
