#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tenon/math/color.h"

namespace tenon {

/// The picture while it is taken: linear light, rows from top to bottom. Threads may set different pixels at once.
class Film {
 public:
  Film() = default;
  Film(int width, int height)
      : width_(width), height_(height), rgb_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

  int width() const { return width_; }
  int height() const { return height_; }

  void set(int x, int y, const Rgb& light) {
    float* pixel = &rgb_[index(x, y)];
    pixel[0] = static_cast<float>(light.r);
    pixel[1] = static_cast<float>(light.g);
    pixel[2] = static_cast<float>(light.b);
  }
  Rgb at(int x, int y) const {
    const float* pixel = &rgb_[index(x, y)];
    return {pixel[0], pixel[1], pixel[2]};
  }
  /// Red, green and blue of every pixel, row by row.
  std::span<const float> rgb() const { return rgb_; }

  /// What a film of that size takes.
  static constexpr double bytes(int width, int height) { return 3.0 * sizeof(float) * width * height; }

 private:
  std::size_t index(int x, int y) const {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x));
  }

  int width_ = 0, height_ = 0;
  std::vector<float> rgb_;
};

}  // namespace tenon
