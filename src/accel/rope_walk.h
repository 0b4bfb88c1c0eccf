#pragma once

#include <algorithm>
#include <limits>

#include "accel/roped_bsp.h"
#include "accel/structure.h"
#include "kdtree/ray_box.h"

namespace tenon {

/// Follows rays along the ropes of a BSP tree, from the cell where the ray starts and without ever going back up
/// (Křivánek & Bubník, "Ropes" and "Rope trees").
///
/// A ray that leaves a hit starts in the cell where the last hit of the thread lay, if that holds its origin: then the
/// way down from the root is saved. Whether it was saved changes nothing but the time.
///
/// *No step is lost to rounding and none is repeated.* The ray's position is tracked with its parameter, which never
/// falls. Rounded o + t d grows with t, so each coordinate moves one way only; it is kept within the cell, and across
/// the exit face it is the face's. The next cell holds the position and reaches past it along every axis the ray moves
/// along (side_of), but for an axis along which the old cell already ended there, a ray through an edge. So each step
/// moves the position, or takes one such axis, of three, past it: the walk ends. The cell found may be off by the
/// rounding of the position, which the margin of the boxes covers (BspTree).
///
/// cells_visited counts nodes: inner ones, rope trees' and leaves; next_box_calls counts steps from leaf to leaf.
class RopeWalk {
 public:
  struct Scratch {
    std::uint32_t cell_of_last_hit = RopedCell::none;
  };

  RopeWalk(RopedBsp bsp, bool mailbox) : bsp_(std::move(bsp)), mailbox_(mailbox) {}

  void traverse(Walk& walk, Scratch& scratch) const {
    walk.use_mailbox(mailbox_);
    const Ray& ray = walk.ray();
    const auto [t_in, t_out] = clip(BoxRay(ray), bsp_.box());
    if (t_in > t_out) return;
    double t = t_in;
    Vec3 position = position_at(ray, t, bsp_.box());
    TraversalCounters& counters = walk.counters();
    std::uint32_t at = find_start(walk, scratch, position);
    for (;;) {
      const RopedCell& cell = bsp_.cells()[at];
      for (std::uint32_t i = 0; i < cell.content.item_count; ++i) {
        walk.reveal(bsp_.items()[cell.content.first_item + i]);
      }
      const Exit exit = find_exit(ray, cell.box);
      t = std::max(t, exit.t);
      if (walk.settle(t)) {
        // Shadow rays come between the rays that leave one hit.
        if (walk.query().kind != RayKind::shadow) scratch.cell_of_last_hit = at;
        return;
      }
      if (!exit.found) return;
      const std::uint32_t rope = cell.ropes[exit.face.index()];
      if (rope == RopedCell::none) return;
      advance(ray, t, cell.box, exit.face, position);
      at = bsp_.locate(rope, position, ray.direction, counters.cells_visited);
      ++counters.next_box_calls;
    }
  }

  std::size_t memory_bytes() const { return bsp_.memory_bytes(); }
  std::size_t boxes() const { return bsp_.nodes().size(); }
  int depth() const { return bsp_.depth(); }

 private:
  struct Exit {
    double t = std::numeric_limits<double>::infinity();
    CellFace face;
    bool found = false;
  };

  std::uint32_t find_start(Walk& walk, const Scratch& scratch, const Vec3& position) const {
    const std::uint32_t last = scratch.cell_of_last_hit;
    if (walk.query().from != nullptr && last != RopedCell::none && bsp_.cells()[last].box.contains(position)) {
      ++walk.counters().cells_visited;
      return last;
    }
    return bsp_.locate(0, position, walk.ray().direction, walk.counters().cells_visited);
  }

  static Vec3 position_at(const Ray& ray, double t, const Box3& within) {
    Vec3 position = ray.origin;
    for (int axis = 0; axis < 3; ++axis) {
      // Where the ray does not move, an infinite t must not make it nothing.
      if (ray.direction[axis] != 0) position[axis] += t * ray.direction[axis];
    }
    return min(max(position, within.lower), within.upper);
  }

  // The face through which the ray leaves the cell; at edges and corners the first of them.
  static Exit find_exit(const Ray& ray, const Box3& cell) {
    Exit exit;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = ray.direction[axis];
      if (d == 0) continue;
      const double t = ((d > 0 ? cell.upper : cell.lower)[axis] - ray.origin[axis]) / d;
      if (t < exit.t) exit = {t, {axis, d > 0}, true};
    }
    return exit;
  }

  // Moves the position along the ray to `t`, within the cell, and onto the exit face.
  static void advance(const Ray& ray, double t, const Box3& cell, CellFace face, Vec3& position) {
    const Vec3 reached = position_at(ray, t, cell);
    for (int axis = 0; axis < 3; ++axis) {
      if (ray.direction[axis] > 0) position[axis] = std::max(position[axis], reached[axis]);
      if (ray.direction[axis] < 0) position[axis] = std::min(position[axis], reached[axis]);
    }
    position[face.axis] = (face.above ? cell.upper : cell.lower)[face.axis];
  }

  RopedBsp bsp_;
  bool mailbox_;
};

}  // namespace tenon
