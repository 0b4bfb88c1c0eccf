#pragma once

#include <cstdint>
#include <span>

namespace tenon {

/// Which sample of which pixel.
struct SampleId {
  int x = 0, y = 0;
  std::uint32_t index = 0;
};

/// Two numbers in (0, 1).
struct Sample2 {
  double u = 0, v = 0;
};

/// The pairs of numbers a sample of a pixel is made of; how many the film, the camera and an integrator take.
namespace sample_pair {
inline constexpr std::uint32_t pixel = 0;
inline constexpr std::uint32_t lens = 1;
inline constexpr std::uint32_t first_bounce = 2;  ///< integrators: from here on
}  // namespace sample_pair

/// Numbers for everything that a picture draws at random. Each follows from the seed, the pixel, the sample's index and
/// the pair that is asked for, and from nothing else: not from tiles, threads, or how many samples there are.
///
/// Every pair is the two-dimensional Sobol sequence, a (0,2)-sequence in base 2: the first 2^k samples of a pixel, and
/// every later block of as many, hold one point in each box of area 2^-k. Pairs are made independent of each other, and
/// pixels too, by Owen scrambling of the points and of the order they come in (Burley, "Practical Hash-based Owen
/// Scrambling", JCGT 9(4), 2020, §5: padding).
class Sampler {
 public:
  explicit Sampler(std::uint64_t seed = 0) : seed_(seed) {}

  /// One pair of each of many samples: scrambling many at once takes a fraction of the time.
  /// @param pairs  as long as `samples`
  void draw(std::span<const SampleId> samples, std::uint32_t pair, std::span<Sample2> pairs) const;

  Sample2 operator()(const SampleId& sample, std::uint32_t pair) const {
    Sample2 one;
    draw({&sample, 1}, pair, {&one, 1});
    return one;
  }

 private:
  std::uint64_t seed_;
};

/// The i-th point of the two-dimensional Sobol sequence, as 32-bit fractions: the van der Corput sequence, and the
/// product with Pascal's matrix mod 2 (direction numbers v0 = 2^31, v_k+1 = v_k xor v_k / 2; Sobol 1967).
struct SobolPoint {
  std::uint32_t u = 0, v = 0;
};
SobolPoint sobol_point(std::uint32_t i);

}  // namespace tenon
