#pragma once

#include <array>
#include <cstdint>

#include "tenon/math/box3.h"

namespace tenon {

/// A cell of a grid: its number along each axis.
using CellIndex = std::array<std::uint32_t, 3>;

/// The cells from `first` to `last`, both included, along each axis.
struct CellRange {
  CellIndex first{};
  CellIndex last{};

  friend constexpr bool operator==(const CellRange&, const CellRange&) = default;
};

/// A box of space cut into equal cells, numbered from 0.
///
/// RR-612 numbers from 1 and starts its addresses at [1,1,1], which its own index formulas (§3.4) would place outside
/// the grid; from 0 they agree. Its formula for the box of a point (§4.1) gives one cell too many on the maximal faces:
/// numbers are clamped.
class GridGeometry {
 public:
  GridGeometry() = default;
  GridGeometry(const Box3& space, const CellIndex& count) : space_(space), count_(count) {
    const Vec3 size = space.size();
    for (int axis = 0; axis < 3; ++axis) {
      cell_[axis] = size[axis] / count[static_cast<std::size_t>(axis)];
      inverse_cell_[axis] = 1 / cell_[axis];
    }
  }

  const Box3& space() const { return space_; }
  const CellIndex& count() const { return count_; }
  std::uint32_t count(int axis) const { return count_[static_cast<std::size_t>(axis)]; }
  const Vec3& cell() const { return cell_; }

  /// The coordinate of the plane below cell number `i`. With a power of two of cells it does not depend on which.
  double face(int axis, std::uint32_t i) const { return space_.lower[axis] + i * cell_[axis]; }

  /// The number of the cell that holds x, no less than `first` and no more than `last`.
  std::uint32_t index(int axis, double x, std::uint32_t first, std::uint32_t last) const {
    const double i = (x - space_.lower[axis]) * inverse_cell_[axis];
    if (!(i > first)) return first;  // also what is not a number
    return i >= last ? last : static_cast<std::uint32_t>(i);
  }
  std::uint32_t index(int axis, double x) const { return index(axis, x, 0, count(axis) - 1); }

  CellIndex index(const Vec3& p) const { return {index(0, p.x), index(1, p.y), index(2, p.z)}; }

  /// The cells that a box reaches into; the box must overlap the space.
  CellRange range(const Box3& box) const { return {index(box.lower), index(box.upper)}; }

  /// The box of space that the cells fill.
  Box3 box(const CellRange& range) const {
    Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      box.lower[axis] = face(axis, range.first[a]);
      box.upper[axis] = face(axis, range.last[a] + 1);
    }
    return box;
  }

 private:
  Box3 space_;
  CellIndex count_{1, 1, 1};
  Vec3 cell_;
  Vec3 inverse_cell_;
};

}  // namespace tenon
