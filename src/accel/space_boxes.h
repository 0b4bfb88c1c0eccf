#pragma once

#include <optional>
#include <vector>

#include "accel/enclosing_sphere.h"
#include "accel/grid_ray.h"
#include "accel/midpoint_subdivision.h"
#include "accel/screen_rectangles.h"
#include "accel/space_axes.h"
#include "accel/walk.h"

namespace tenon {

/// The linear array of boxes that the subdivision leaves (RR-612 §3.3), and the tracing of rays through it (§4).
///
/// Of a box's subtree its bounded leaves are kept. The classifier evaluates the whole tree with what was revealed to
/// it, which in the box is the subtree (Projection), so the operations need not be kept too.
class SpaceBoxes {
 public:
  using Number = std::uint32_t;

  SpaceBoxes() = default;
  /// @param grid    the smallest boxes
  /// @param margin  enclosure_margin() of the scene
  SpaceBoxes(const GridGeometry& grid, const Levels& levels, const SpaceAxes& axes, double margin)
      : grid_(grid), levels_(levels), axes_(axes), margin_(margin) {}

  /// Gives each box a sphere around what is in it and, for the view, a rectangle. Before the first add().
  void use_filters(const ScreenView* view) {
    filters_ = true;
    if (view != nullptr) rectangles_.emplace(axes_.from_world(*view), 0, margin_);
  }

  /// Makes room for these boxes.
  void reserve(const std::vector<MidpointBox>& boxes);
  Number add(const MidpointBox& box, Projection& projection);

  std::size_t size() const { return boxes_.size(); }
  /// The most halvings that made a box.
  int depth() const { return depth_; }
  std::size_t memory_bytes() const {
    return boxes_.capacity() * sizeof(Box) + leaves_.capacity() * sizeof(LeafId) +
           spheres_.capacity() * sizeof(EnclosingSphere) + (rectangles_ ? rectangles_->bytes() : 0);
  }

  /// Follows a ray from box to box, until it is done or leaves the space.
  /// @param find_box  the number of the box that a cell of the grid lies in
  template <class FindBox>
  void trace(Walk& walk, const FindBox& find_box) const {
    if (boxes_.empty()) return;
    const Ray ray = axes_.from_world(walk.ray());
    GridRay grid_ray(grid_, ray);
    if (!grid_ray.enter()) return;
    for (;;) {
      const Number number = find_box(grid_ray.cell());
      const Box& box = boxes_[number];
      ++walk.counters().cells_visited;
      if (box.primitives > 0 && !is_missed(number, ray, walk.query())) {
        for (std::uint32_t i = 0; i < box.primitives; ++i) walk.reveal(leaves_[box.first_leaf + i]);
      }
      if (walk.settle(grid_ray.exit(box.cells))) return;
      ++walk.counters().next_box_calls;
      if (!grid_ray.next_box(box.cells)) return;
    }
  }

 private:
  struct Box {
    CellRange cells;  // its address and size, in smallest boxes
    std::uint32_t first_leaf;
    std::uint32_t primitives;  // none: the box is empty
  };

  // Where the ray passes what is in the box, the root is false all through it, whatever is known of the leaves
  // (Projection::enclose): nothing has to be revealed.
  bool is_missed(Number number, const Ray& ray, const RayQuery& query) const {
    if (!filters_) return false;
    if (query.kind == RayKind::primary && rectangles_) {
      return !rectangles_->covers(number, query.pixel_x, query.pixel_y);
    }
    return spheres_[number].missed_by(ray);
  }

  GridGeometry grid_;
  Levels levels_{};
  SpaceAxes axes_;
  double margin_ = 0;
  bool filters_ = false;
  std::vector<Box> boxes_;
  std::vector<LeafId> leaves_;
  std::vector<EnclosingSphere> spheres_;        // by box, with filters
  std::optional<ScreenRectangles> rectangles_;  // by box, with filters and a view
  int depth_ = 0;
};

}  // namespace tenon
