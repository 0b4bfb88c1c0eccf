#include "render/noise.h"

#include <cmath>

namespace tenon {

double noise(const Film& film, const PixelWindow& window) {
  double sum = 0;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const Rgb error = film.error(x, y), light = film.light(x, y);
      const double together = std::fabs(error.r) + std::fabs(error.g) + std::fabs(error.b);
      if (together > 0) sum += together / std::sqrt(light.r + light.g + light.b);
    }
  }
  return sum / static_cast<double>(window.pixels());
}

}  // namespace tenon
