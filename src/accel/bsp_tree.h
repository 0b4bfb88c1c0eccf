#pragma once

#include <cstdint>
#include <vector>

#include "csg/enclosures.h"
#include "tenon/math/box3.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// A node of a BSP tree: a plane across one axis, or a leaf.
struct BspNode {
  static constexpr std::uint32_t leaf_axis = 3;

  double plane = 0;
  std::uint32_t first = 0;  ///< the child below the plane, the other follows it; of a leaf: its cell
  std::uint32_t axis = leaf_axis;

  bool is_leaf() const { return axis == leaf_axis; }
};

/// Which child of a node holds a point that moves along `direction`: 0 below its plane, 1 above. In the plane, the side
/// it moves to.
inline std::uint32_t side_of(const BspNode& node, const Vec3& point, const Vec3& direction) {
  const int axis = static_cast<int>(node.axis);
  return point[axis] > node.plane || (point[axis] == node.plane && direction[axis] >= 0) ? 1 : 0;
}

/// What a leaf of the tree refers to: a stretch of BspTree::items.
struct BspCell {
  std::uint32_t first_item = 0;
  std::uint32_t item_count = 0;
};

/// How a splitting plane is chosen (Křivánek & Bubník).
enum class BspSplit {
  kaplan,          ///< through the middle of the cell, the axes in turn
  macdonald_booth  ///< where MacDonald & Booth's surface area heuristic is least
};

struct BspOptions {
  BspSplit split = BspSplit::kaplan;
  int leaf = 4;    ///< a node with no more primitives is a leaf
  int depth = 20;  ///< the most splits on the way from the root to a leaf

  static constexpr int deepest = 60;
};

/// Binary space partition by planes across the axes. Children are adjacent and come after their parent.
///
/// A primitive is referred to from every cell its box overlaps, and not from one it only touches: boxes are grown by
/// enclosure_margin(), so a primitive absent from a cell keeps that distance from it. Whatever rounding does to the
/// parameter of a plane, a ray that is sent to the wrong side of it by less than that finds what it can meet.
struct BspTree {
  Box3 box;
  std::vector<BspNode> nodes;
  std::vector<BspCell> cells;
  std::vector<LeafId> items;
  int depth = 0;

  std::size_t memory_bytes() const {
    return nodes.capacity() * sizeof(BspNode) + cells.capacity() * sizeof(BspCell) + items.capacity() * sizeof(LeafId);
  }
};

/// Builds the tree over the leaves' boxes within `box`.
BspTree build_bsp_tree(const std::vector<EnclosedLeaf>& leaves, const Box3& box, const BspOptions& options);

}  // namespace tenon
