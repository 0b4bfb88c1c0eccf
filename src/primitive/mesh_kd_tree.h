#pragma once

#include <array>

#include "kdtree/kd_walk.h"
#include "primitive/mesh_line.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// A kd-tree over the triangles of a mesh as Zajíček has it (2012, §3.2 and 4.1): built by the modified surface area
/// heuristic, nodes of 8 bytes, Havran's traversal. A triangle that stands in several leaves is mostly tested once: the
/// ray keeps track of those that it met last (inverse mailboxing, §2.5).
class MeshKdTree {
 public:
  explicit MeshKdTree(const TriangleMesh& mesh);

  /// Calls visit(triangle) for each triangle whose box the line meets, with all that it may be wrong by; for some more
  /// than once.
  template <class Visitor>
  void walk(const MeshLine& line, Visitor&& visit) const;

  /// Calls visit(triangle), which returns whether to go on, for each triangle of the leaves that meet a box; for some
  /// more than once.
  /// @return false when a visit ended the walk
  template <class Visitor>
  bool walk(const Box3& box, Visitor&& visit) const;

  std::size_t bytes() const { return tree_.memory_bytes(); }

 private:
  Box3 box_around(const MeshLine& line) const;

  KdTree tree_;
  double margin_ = 0;  // by which the triangles' boxes are grown
};

template <class Visitor>
void MeshKdTree::walk(const MeshLine& line, Visitor&& visit) const {
  constexpr std::size_t slots = 64;
  std::array<std::uint32_t, slots> met;
  met.fill(~std::uint32_t{0});
  const auto meet = [&](std::uint32_t triangle) {
    if (met[triangle % slots] != triangle) visit(triangle);
    met[triangle % slots] = triangle;
    return true;
  };
  // The traversal knows of no errors: the boxes' margin must exceed the line's, and those of the traversal itself: some
  // ten roundings of numbers four times as large as those that the growth takes eight of. A line that is known less
  // well, from very far away, meets whatever it is beside.
  if (!(8 * max_component(line.growth) <= margin_)) {
    walk(box_around(line), meet);
    return;
  }
  const double begin = -2 * line.farthest;
  KdStack stack;
  walk_kd_tree(tree_, {line.origin + begin * line.direction, line.direction}, stack,
               [&](const KdNode& leaf, double /*t_out*/) {
                 for (const std::uint32_t triangle : tree_.items_of(leaf)) meet(triangle);
                 return false;
               });
}

template <class Visitor>
bool MeshKdTree::walk(const Box3& box, Visitor&& visit) const {
  std::array<std::uint32_t, KdTree::deepest + 1> stack;
  std::size_t waiting = 0;
  stack[waiting++] = 0;
  while (waiting > 0) {
    const KdNode node = tree_.nodes[stack[--waiting]];
    if (node.is_leaf()) {
      for (const std::uint32_t triangle : tree_.items_of(node)) {
        if (!visit(triangle)) return false;
      }
      continue;
    }
    if (!(box.lower[node.axis()] > node.plane())) stack[waiting++] = node.index();
    if (!(box.upper[node.axis()] < node.plane())) stack[waiting++] = node.index() + 1;
  }
  return true;
}

}  // namespace tenon
