#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "kdtree/kd_tree.h"
#include "kdtree/ray_box.h"

namespace tenon {

/// The stack of one traversal of a kd-tree.
struct KdStack {
  /// A far child that waits, and where the ray leaves it.
  struct Entry {
    std::uint32_t node;
    double t;
    Vec3 point;
  };
  std::array<Entry, KdTree::deepest> entries;
};

/// Visits the leaves of a kd-tree along a ray, near ones first (Havran's traversal by entry and exit points, TA_B,
/// which the thesis refers to in §1.3.4 and §3.1). The side of a plane is decided by comparing coordinates of the
/// points where the ray enters and leaves the cell with the plane; t is computed only where it cuts the cell. Then the
/// point's coordinate across the plane is the plane's, so that both children see the same number.
///
/// A point lying in a plane counts as below it, on either side of the cut: what ends or begins there keeps the boxes'
/// margin from it, so a ray within the plane may be sent to one side alone.
///
/// @param visit  bool(leaf, t_out): returns true to stop; t_out is where the ray leaves the leaf's cell
/// @return the number of nodes visited
template <class Visit>
std::uint64_t walk_kd_tree(const KdTree& tree, const Ray& ray, KdStack& stack, Visit&& visit) {
  const auto [t_in, t_out] = clip(BoxRay(ray), tree.box);
  if (t_in > t_out) return 0;
  const auto point_at = [&ray](double t) {
    Vec3 point = ray.origin;
    for (int axis = 0; axis < 3; ++axis) {
      // Where the ray does not move, an infinite t must not make it nothing.
      if (ray.direction[axis] != 0) point[axis] += t * ray.direction[axis];
    }
    return point;
  };
  Vec3 enter = point_at(t_in), leave = point_at(t_out);
  double t_leave = t_out;
  std::uint64_t visited = 0;
  std::size_t waiting = 0;
  std::uint32_t at = 0;
  for (;;) {
    KdNode node = tree.nodes[at];
    ++visited;
    while (!node.is_leaf()) {
      const int axis = node.axis();
      const double plane = node.plane();
      const bool enters_above = enter[axis] > plane, leaves_above = leave[axis] > plane;
      at = node.index() + (enters_above ? 1 : 0);
      if (enters_above != leaves_above) {
        stack.entries[waiting++] = {node.index() + (leaves_above ? 1 : 0), t_leave, leave};
        t_leave = (plane - ray.origin[axis]) / ray.direction[axis];
        leave = point_at(t_leave);
        leave[axis] = plane;
      }
      node = tree.nodes[at];
      ++visited;
    }
    if (visit(node, t_leave) || waiting == 0) return visited;
    --waiting;
    at = stack.entries[waiting].node;
    enter = leave;
    t_leave = stack.entries[waiting].t;
    leave = stack.entries[waiting].point;
  }
}

}  // namespace tenon
