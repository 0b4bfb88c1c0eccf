#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "primitive/mesh_line.h"
#include "tenon/math/box3.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// A bounding volume hierarchy over the triangles of a mesh, four children a node, built top down by the surface area
/// heuristic over sixteen bins (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007).
class MeshBvh {
 public:
  MeshBvh() = default;
  explicit MeshBvh(const TriangleMesh& mesh);
  /// Over any boxes, which then stand for the triangles below.
  explicit MeshBvh(std::vector<Box3> boxes);

  /// Calls visit(triangle) for each triangle whose box the line meets, with all that it may be wrong by.
  template <class Visitor>
  void walk(const MeshLine& line, Visitor&& visit) const;

  /// Calls visit(triangle), which returns whether to go on, for each triangle whose box meets this one.
  /// @return false when a visit ended the walk
  template <class Visitor>
  bool walk(const Box3& box, Visitor&& visit) const;

  /// The largest n·p over the vertices.
  double support(const TriangleMesh& mesh, const Vec3& n) const;

  std::size_t bytes() const { return nodes_.size() * sizeof(Node) + order_.size() * sizeof(std::uint32_t); }

 private:
  static constexpr std::size_t width = 4;
  static constexpr std::size_t leaf_size = 4;
  // Each level pushes three more than it takes, and splits its triangles at least in halves once it is this deep.
  static constexpr int deepest_by_cost = 48;
  static constexpr std::size_t stack_size = 3 * (deepest_by_cost + 32) + 1;

  // A child: a node, or the triangles order_[first, first + count).
  struct Child {
    std::uint32_t first = 0;
    std::uint32_t count = 0;  // 0 for a node
  };
  // Boxes in float, rounded outward; a child that is not there has an empty one.
  struct alignas(64) Node {
    std::array<std::array<float, width>, 3> lower, upper;
    std::array<Child, width> children;
  };

  class Builder;
  Box3 box_of(const Node& node, std::size_t i) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
};

template <class Visitor>
void MeshBvh::walk(const MeshLine& line, Visitor&& visit) const {
  if (nodes_.empty()) return;
  const MeshSlabs slabs(line);
  std::array<std::uint32_t, stack_size> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    std::array<double, width> enter, leave;
    enter.fill(-Box3::inf);
    leave.fill(Box3::inf);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& near = slabs.forward[axis] ? node.lower[axis] : node.upper[axis];
      const auto& far = slabs.forward[axis] ? node.upper[axis] : node.lower[axis];
      for (std::size_t i = 0; i < width; ++i) {
        enter[i] = std::max(enter[i], (near[i] - slabs.near_begin[axis]) * slabs.inverse[axis]);
        leave[i] = std::min(leave[i], (far[i] - slabs.far_begin[axis]) * slabs.inverse[axis]);
      }
    }
    for (std::size_t i = 0; i < width; ++i) {
      if (enter[i] > leave[i]) continue;
      const Child child = node.children[i];
      if (child.count == 0) {
        if (child.first != 0) stack[top++] = child.first;
      } else {
        for (std::uint32_t k = 0; k < child.count; ++k) visit(order_[child.first + k]);
      }
    }
  }
}

template <class Visitor>
bool MeshBvh::walk(const Box3& box, Visitor&& visit) const {
  if (nodes_.empty()) return true;
  std::array<std::uint32_t, stack_size> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    for (std::size_t i = 0; i < width; ++i) {
      const Child child = node.children[i];
      if (!box_of(node, i).overlaps(box)) continue;
      if (child.count == 0) {
        if (child.first != 0) stack[top++] = child.first;
      } else {
        for (std::uint32_t k = 0; k < child.count; ++k) {
          if (!visit(order_[child.first + k])) return false;
        }
      }
    }
  }
  return true;
}

}  // namespace tenon
