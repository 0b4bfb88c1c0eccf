#pragma once

#include <algorithm>
#include <cstddef>

namespace tenon {

/// Part of a picture: columns [x0, x1), rows [y0, y1).
struct Tile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  std::size_t pixels() const { return static_cast<std::size_t>(x1 - x0) * static_cast<std::size_t>(y1 - y0); }
};

/// A picture cut into squares, those at the right and lower rim smaller; numbered row by row.
class TileGrid {
 public:
  TileGrid(int width, int height, int size)
      : width_(width), height_(height), size_(size), columns_((width - 1) / size + 1), rows_((height - 1) / size + 1) {}

  std::size_t size() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
  Tile operator[](std::size_t i) const {
    const int x0 = static_cast<int>(i % static_cast<std::size_t>(columns_)) * size_;
    const int y0 = static_cast<int>(i / static_cast<std::size_t>(columns_)) * size_;
    return {x0, y0, std::min(width_ - x0, size_) + x0, std::min(height_ - y0, size_) + y0};
  }

 private:
  int width_, height_, size_, columns_, rows_;
};

}  // namespace tenon
