#include "render/noise.h"

#include <cmath>

namespace tenon {

double noise(const Film& film, const PixelWindow& window) {
  double sum = 0;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const Rgb variance = film.variance(x, y), light = film.light(x, y);
      const double error = std::sqrt(variance.r) + std::sqrt(variance.g) + std::sqrt(variance.b);
      if (error > 0) sum += error / std::sqrt(light.r + light.g + light.b);
    }
  }
  return sum / static_cast<double>(window.pixels());
}

}  // namespace tenon
