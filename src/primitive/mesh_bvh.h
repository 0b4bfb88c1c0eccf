#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "primitive/mesh_line.h"
#include "tenon/base/function_ref.h"
#include "tenon/math/box3.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

struct FloatLine;

/// A bounding volume hierarchy over the triangles of a mesh, eight children a node, built top down by the surface area
/// heuristic over sixteen bins (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007).
///
/// Boxes and triangles are in single precision, in a frame of their own: around the middle, scaled to about 1. They
/// only leave out what a line certainly misses, with all that the line, the frame and single precision are wrong by.
class MeshBvh {
 public:
  MeshBvh() = default;
  explicit MeshBvh(const TriangleMesh& mesh);
  /// Over any boxes, which then stand for the triangles below.
  explicit MeshBvh(std::span<const Box3> boxes);

  /// Calls visit(triangle) for each triangle that the line may meet, with all that it may be wrong by, and for some
  /// whose box it may meet.
  /// @param window  those whose box the line meets beside it alone may be left out
  void walk(const MeshLine& line, const LineWindow& window, FunctionRef<void(std::uint32_t)> visit) const;

  /// The same, those in nearer boxes mostly first, as far as is still of interest: visit(triangle) returns the t of the
  /// line where that ends from now on.
  void walk_forward(const MeshLine& line, const LineWindow& window, FunctionRef<double(std::uint32_t)> visit) const;

  /// That, and which part of it is asked for, in the frame of the hierarchy.
  void walk_forward(FloatLine& line, FunctionRef<double(std::uint32_t)> visit) const;

  /// Calls visit(triangle), which returns whether to go on, for each triangle whose leaf meets this box.
  /// @return false when a visit ended the walk
  template <class Visitor>
  bool walk(const Box3& box, Visitor&& visit) const;

  /// The largest n·p over the vertices.
  double support(const TriangleMesh& mesh, const Vec3& n) const;

  std::size_t bytes() const {
    return nodes_.size() * sizeof(Node) + order_.size() * sizeof(std::uint32_t) + blocks_.size() * sizeof(Block);
  }

  static constexpr std::size_t width = 8;
  // Each level pushes seven more than it takes, and splits its triangles at least in halves once it is this deep.
  static constexpr int deepest_by_cost = 48;
  static constexpr std::size_t stack_size = (width - 1) * (deepest_by_cost + 32) + 1;
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// A node, a leaf, or nothing: the root is nobody's child.
  struct Child {
    static constexpr std::uint32_t leaf_bit = 0x80000000;
    std::uint32_t bits = 0;

    bool is_none() const { return bits == 0; }
    bool is_leaf() const { return (bits & leaf_bit) != 0; }
    std::uint32_t index() const { return bits & ~leaf_bit; }
  };
  /// Boxes rounded outward, by axis their lower and their upper ends; a child that is not there has an empty one, from
  /// +inf to -inf.
  struct alignas(32) Node {
    std::array<std::array<std::array<float, width>, 2>, 3> ends;
    std::array<Child, width> children;
  };
  /// The triangles of a leaf: by corner, by axis.
  struct alignas(32) Block {
    std::array<std::array<std::array<float, width>, 3>, 3> corners;
  };
  /// Where the frame of boxes and triangles lies: a point of it is scale * (p - center).
  struct Frame {
    Vec3 center;
    double scale = 1;  ///< a power of two

    Box3 box_from_outside(const Box3& box) const;
    Box3 box_to_outside(const Box3& box) const;
  };

  const Frame& frame() const { return frame_; }
  std::span<const Node> nodes() const { return nodes_; }
  /// Of a mesh one for each leaf, otherwise none.
  std::span<const Block> blocks() const { return blocks_; }
  /// The triangles of a leaf; `none` where it is not full.
  std::span<const std::uint32_t> leaf(std::uint32_t index) const {
    return {order_.data() + index * leaf_size_, leaf_size_};
  }

 private:
  class Builder;
  static Box3 box_of(const Node& node, std::size_t i) {
    const auto at = [&](std::size_t side) {
      return Vec3{node.ends[0][side][i], node.ends[1][side][i], node.ends[2][side][i]};
    };
    return {at(0), at(1)};
  }
  void fill_blocks(const TriangleMesh& mesh);

  Frame frame_;
  std::size_t leaf_size_ = 1;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  // leaf by leaf
  std::vector<Block> blocks_;
};

template <class Visitor>
bool MeshBvh::walk(const Box3& box, Visitor&& visit) const {
  if (nodes_.empty()) return true;
  const Box3 sought = frame_.box_from_outside(box);
  std::array<std::uint32_t, stack_size> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    for (std::size_t i = 0; i < width; ++i) {
      const Child child = node.children[i];
      if (child.is_none() || !box_of(node, i).overlaps(sought)) continue;
      if (!child.is_leaf()) {
        stack[top++] = child.index();
        continue;
      }
      for (const std::uint32_t triangle : leaf(child.index())) {
        if (triangle != none && !visit(triangle)) return false;
      }
    }
  }
  return true;
}

}  // namespace tenon
