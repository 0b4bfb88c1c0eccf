#pragma once

#include <cmath>
#include <cstdint>

#include "tenon/math/vec3.h"

namespace tenon {

/// Random numbers that are the same everywhere (splitmix64, Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53); }
  bool chance(double probability) { return uniform(0, 1) < probability; }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
  /// Spread evenly over its order of magnitude, from 10^low to 10^high.
  double magnitude(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  double sign() { return chance(0.5) ? 1 : -1; }
  Vec3 in_cube() {
    const double x = uniform(-1, 1), y = uniform(-1, 1);
    return {x, y, uniform(-1, 1)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = in_cube();
      const double l = dot(v, v);
      if (l > 0.01 && l < 1) return v / std::sqrt(l);
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace tenon
