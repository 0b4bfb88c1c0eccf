#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tenon/base/huge_pages.h"
#include "tenon/math/box3.h"

namespace tenon::cells {

inline constexpr int node_width = 8;

/// What stands below a node's child: another node, a cell, or nothing.
struct ChildRef {
  static constexpr std::uint32_t cell_bit = 0x80000000;
  std::uint32_t bits = cell_bit - 1;

  static constexpr ChildRef node(std::size_t index) { return {static_cast<std::uint32_t>(index)}; }
  static constexpr ChildRef cell(std::size_t index) { return {static_cast<std::uint32_t>(index) | cell_bit}; }
  constexpr bool is_none() const { return bits == cell_bit - 1; }
  constexpr bool is_cell() const { return (bits & cell_bit) != 0; }
  constexpr std::uint32_t index() const { return bits & ~cell_bit; }
};

/// Eight boxes in single precision, relative to the tree's center and grown by the slack. A child that is not there has
/// a box that no ray meets.
struct alignas(64) WideNode {
  WideNode();
  void set_child(std::size_t lane, const Box3& box, ChildRef child);

  /// By axis; lower and upper ends.
  std::array<std::array<std::array<float, node_width>, 2>, 3> ends;
  std::array<ChildRef, node_width> children;
  /// By octant of a ray's direction (bit a: backward along axis a): the lanes, three bits each, from the child that it
  /// meets last to that which it meets first. Children do not overlap but by the slack, so the order is that of planes.
  std::array<std::uint32_t, 8> last_to_first;
};

struct SubdivisionNode;

/// Makes eight-wide nodes of a binary tree, from the root down: the largest of a node's children are opened until there
/// are eight.
/// @param center, slack  of the CellTree: where the boxes' coordinates begin, and how far boxes are grown
/// @param root_slot      the root becomes nodes[root_slot]; the others are added at the end
/// @return the depth
int collapse(std::span<const SubdivisionNode> binary, std::uint32_t root, const Vec3& center, double slack,
             std::size_t root_slot, HugePageVector<WideNode>& nodes);

}  // namespace tenon::cells
