#pragma once

#include <limits>

#include "accel/grid_geometry.h"
#include "kdtree/ray_box.h"

namespace tenon {

/// A ray on its way through boxes that are made of the cells of one grid: the next box by three faces (RR-612 §4.2).
///
/// The paper pushes the point P where the ray leaves a box by half a smallest box along the normal of the face it lies
/// in, and along several at edges and vertices, and looks up the box that holds the pushed point P'. Half a cell beyond
/// a face of the grid is the middle of the next cell, whatever rounding did to P; so that number is known without P'.
/// Along the other axes P lies in the box it leaves: its number is that of P, kept within the box and never behind the
/// ray. Every step therefore moves on along some axis and back along none: no ray circles.
///
/// Nothing is skipped either. P errs by a few units in the last place of the ray's origin and of P, which is far below
/// enclosure_margin(). So a box that the ray passes and a step skips is one that it passes within less than the margin
/// of the boxes before and after, which hold whatever the skipped one holds there, for primitives stand in every box
/// that their enclosure, grown by the margin, touches.
class GridRay {
 public:
  GridRay(const GridGeometry& grid, const Ray& ray) : grid_(grid), ray_(ray), box_ray_(ray) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double inverse = box_ray_.inverse[static_cast<int>(a)];
      sign_[a] = !std::isfinite(inverse) ? 0 : inverse > 0 ? 1 : -1;
    }
  }

  /// Goes to the cell where the ray enters the space, or starts.
  /// @return false when it misses the space
  bool enter() {
    const BoxSpan span = clip(box_ray_, grid_.space());
    if (span.empty()) return false;
    cell_ = grid_.index(ray_.at(span.t_in));
    return true;
  }

  /// The cell that the ray has come to.
  const CellIndex& cell() const { return cell_; }

  /// Where the ray leaves the box; infinity when it never does.
  double exit(const CellRange& box) {
    exit_ = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      t_[a] = std::numeric_limits<double>::infinity();
      if (sign_[a] == 0) continue;
      const double face = grid_.face(axis, sign_[a] > 0 ? box.last[a] + 1 : box.first[a]);
      t_[a] = (face - ray_.origin[axis]) * box_ray_.inverse[axis];
      if (t_[a] < exit_) exit_ = t_[a];
    }
    return exit_;
  }

  /// Goes to the next box, after exit().
  /// @return false when that is outside the space
  bool next_box(const CellRange& box) {
    bool inside = exit_ < std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (sign_[a] == 0) continue;
      if (t_[a] > exit_) {
        const double x = ray_.origin[axis] + exit_ * ray_.direction[axis];
        cell_[a] =
            sign_[a] > 0 ? grid_.index(axis, x, cell_[a], box.last[a]) : grid_.index(axis, x, box.first[a], cell_[a]);
      } else if (sign_[a] > 0) {
        cell_[a] = box.last[a] + 1;
        inside &= cell_[a] < grid_.count()[a];
      } else {
        inside &= box.first[a] > 0;
        cell_[a] = box.first[a] - 1;
      }
    }
    return inside;
  }

 private:
  const GridGeometry& grid_;
  Ray ray_;
  BoxRay box_ray_;
  std::array<int, 3> sign_{};  // of the direction; 0 when the ray is parallel to the faces
  CellIndex cell_{};
  std::array<double, 3> t_{};
  double exit_ = 0;
};

}  // namespace tenon
