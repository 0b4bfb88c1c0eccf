#pragma once

#include <algorithm>
#include <cstddef>

#include "tenon/image/picture.h"

namespace tenon {

/// Part of a picture cut into squares by a grid that begins in the picture's corner, whatever part it is; those at the
/// rims are smaller. Numbered row by row.
class TileGrid {
 public:
  static constexpr int side = 16;  ///< pixels

  explicit TileGrid(const PixelWindow& window)
      : window_(window),
        column0_(window.x0 / side),
        row0_(window.y0 / side),
        columns_((window.x1 - 1) / side + 1 - column0_),
        rows_((window.y1 - 1) / side + 1 - row0_) {}

  std::size_t size() const { return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_); }
  PixelWindow operator[](std::size_t i) const {
    const int x0 = (column0_ + static_cast<int>(i % static_cast<std::size_t>(columns_))) * side;
    const int y0 = (row0_ + static_cast<int>(i / static_cast<std::size_t>(columns_))) * side;
    return overlap(window_, {x0, y0, x0 + side, y0 + side});
  }

 private:
  PixelWindow window_;
  int column0_, row0_, columns_, rows_;
};

/// The part of a picture, and as much around it as makes its tiles whole.
inline PixelWindow whole_tiles(const PixelWindow& part, int width, int height) {
  constexpr int side = TileGrid::side;
  return {part.x0 / side * side, part.y0 / side * side, std::min(width, (part.x1 - 1) / side * side + side),
          std::min(height, (part.y1 - 1) / side * side + side)};
}

}  // namespace tenon
