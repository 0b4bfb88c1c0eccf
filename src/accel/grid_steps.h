#pragma once

#include <limits>

#include "accel/grid_geometry.h"
#include "kdtree/ray_box.h"

namespace tenon {

/// What both ways through a uniform grid share: where the ray enters, and a step over one face.
///
/// Cells are passed one by one, through faces only; a ray through an edge or a vertex passes cells in which it has no
/// length. Each step moves on along one axis and back along none. The parameters of the faces err far less than
/// enclosure_margin(), by which the objects in the cells are grown, so it does not matter that the ray is settled a
/// little before or behind the face, nor which of two faces at an edge comes first.
class GridSteps {
 public:
  GridSteps(const GridGeometry& grid, const Ray& ray) : grid_(grid), ray_(ray), box_ray_(ray) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double inverse = box_ray_.inverse[static_cast<int>(a)];
      step_[a] = !std::isfinite(inverse) ? 0 : inverse > 0 ? 1 : -1;
    }
  }

  const CellIndex& cell() const { return cell_; }

 protected:
  // Finds where the ray enters the grid, or starts in it, and that cell.
  bool enter_grid() {
    const BoxSpan span = clip(box_ray_, grid_.space());
    if (span.empty()) return false;
    t_in_ = span.t_in;
    cell_ = grid_.index(ray_.at(t_in_));
    return true;
  }

  // The parameter of the face through which the ray would leave its cell along an axis, from a point of the ray on.
  double face_parameter(int axis, const Vec3& from) const {
    const auto a = static_cast<std::size_t>(axis);
    if (step_[a] == 0) return std::numeric_limits<double>::infinity();
    const double face = grid_.face(axis, step_[a] > 0 ? cell_[a] + 1 : cell_[a]);
    return (face - from[axis]) * box_ray_.inverse[axis];
  }

  // False when that leaves the grid.
  bool step_along(int axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (step_[a] == 0) return false;
    cell_[a] += static_cast<std::uint32_t>(step_[a]);  // below 0 it wraps round to more than any count
    return cell_[a] < grid_.count()[a];
  }

  // x before y before z where they are equal.
  static int smallest(const Vec3& t) {
    if (t.x <= t.y && t.x <= t.z) return 0;
    return t.y <= t.z ? 1 : 2;
  }

  const GridGeometry& grid_;
  Ray ray_;
  BoxRay box_ray_;
  std::array<int, 3> step_{};  // of the direction; 0 when the ray is parallel to the faces
  CellIndex cell_{};
  double t_in_ = 0;
};

/// The classical method of the course: the face that holds the point P where the ray leaves the cell gives the axis
/// along which the index changes by one.
class ClassicSteps : public GridSteps {
 public:
  using GridSteps::GridSteps;

  bool enter() { return enter_grid(); }

  /// Where the ray leaves its cell.
  double exit() {
    const Vec3 t{face_parameter(0, ray_.origin), face_parameter(1, ray_.origin), face_parameter(2, ray_.origin)};
    axis_ = smallest(t);
    return t[axis_];
  }

  /// Goes to the next cell, after exit(). @return false when that is outside the grid
  bool next() { return step_along(axis_); }

 private:
  int axis_ = 0;
};

/// Amanatides's method, as the course has it (J. Amanatides, A. Woo: "A fast voxel traversal algorithm for ray
/// tracing", Eurographics 1987): tx, ty and tz are where the ray meets the next face of each axis, and grow by tDelta.
///
/// They are counted from where the ray enters the grid: n additions then err by n 2^-53 of the grid's size, and not of
/// the distance of the ray's origin.
class AmanatidesSteps : public GridSteps {
 public:
  using GridSteps::GridSteps;

  bool enter() {
    if (!enter_grid()) return false;
    const Vec3 start = ray_.at(t_in_);
    for (int axis = 0; axis < 3; ++axis) {
      t_[axis] = face_parameter(axis, start);
      t_delta_[axis] = grid_.cell()[axis] * std::fabs(box_ray_.inverse[axis]);
    }
    return true;
  }

  double exit() {
    axis_ = smallest(t_);
    return t_in_ + t_[axis_];
  }

  bool next() {
    t_[axis_] += t_delta_[axis_];
    return step_along(axis_);
  }

 private:
  Vec3 t_;
  Vec3 t_delta_;
  int axis_ = 0;
};

}  // namespace tenon
