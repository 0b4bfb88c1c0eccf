#include "render/ambient_light.h"

#include <algorithm>
#include <numbers>

#include "render/environment.h"

namespace tenon {

namespace {

constexpr std::size_t count = 9;

// The real spherical harmonics without their factors.
std::array<double, count> polynomials(const Vec3& d) {
  return {1, d.x, d.y, d.z, d.x * d.y, d.y * d.z, d.x * d.z, 3 * d.z * d.z - 1, d.x * d.x - d.y * d.y};
}

// The squares of those factors times 4 pi, and the cosine's own share of each order.
constexpr std::array<double, count> squares{1, 3, 3, 3, 15, 15, 15, 5.0 / 4, 15.0 / 4};
constexpr std::array<double, count> of_cosine{1,       2.0 / 3, 2.0 / 3, 2.0 / 3, 1.0 / 4,
                                              1.0 / 4, 1.0 / 4, 1.0 / 4, 1.0 / 4};

}  // namespace

AmbientLight::AmbientLight(const Environment& around) {
  if (around.is_uniform()) {
    harmonics_[0] = around.radiance({0, 0, 1});
    return;
  }
  // Drawn in proportion to the light, so that a small sun counts; a grid of draws, for the integrands are smooth.
  constexpr int side = 64;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const auto sample = around.sample({(column + 0.5) / side, (row + 0.5) / side});
      if (!sample) continue;
      const Rgb light = (1 / (4 * std::numbers::pi * sample->density * side * side)) * sample->radiance;
      const std::array<double, count> p = polynomials(sample->direction);
      for (std::size_t k = 0; k < count; ++k) harmonics_[k] += (squares[k] * of_cosine[k] * p[k]) * light;
    }
  }
}

Rgb AmbientLight::operator()(const Vec3& normal) const {
  const std::array<double, count> p = polynomials(normal);
  Rgb sum;
  for (std::size_t k = 0; k < count; ++k) sum += p[k] * harmonics_[k];
  return {std::max(0.0, sum.r), std::max(0.0, sum.g), std::max(0.0, sum.b)};
}

}  // namespace tenon
