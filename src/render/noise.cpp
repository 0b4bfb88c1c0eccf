#include "render/noise.h"

#include <cmath>
#include <numbers>

namespace tenon {

double noise(const Film& film, const PixelWindow& window) {
  double squares = 0;
  for (int y = window.y0; y < window.y1; ++y) {
    for (int x = window.x0; x < window.x1; ++x) {
      const Rgb error = film.error(x, y), light = film.light(x, y);
      const double together = std::fabs(error.r) + std::fabs(error.g) + std::fabs(error.b);
      if (together > 0) squares += together * together / (light.r + light.g + light.b);
    }
  }
  return std::sqrt(2 / std::numbers::pi * squares / static_cast<double>(window.pixels()));
}

}  // namespace tenon
