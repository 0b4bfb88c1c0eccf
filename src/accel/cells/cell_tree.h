#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "accel/cells/cell.h"
#include "accel/cells/cell_build.h"
#include "accel/cells/placed_shape.h"

namespace tenon::cells {

inline constexpr int node_width = 8;

/// What stands below a node's child: another node, a cell, or nothing.
struct ChildRef {
  static constexpr std::uint32_t cell_bit = 0x80000000;
  std::uint32_t bits = cell_bit - 1;

  static constexpr ChildRef node(std::size_t index) { return {static_cast<std::uint32_t>(index)}; }
  static constexpr ChildRef cell(std::size_t index) { return {static_cast<std::uint32_t>(index) | cell_bit}; }
  constexpr bool is_cell() const { return (bits & cell_bit) != 0; }
  constexpr std::uint32_t index() const { return bits & ~cell_bit; }
};

/// Eight boxes in single precision, relative to the tree's center and grown by the slack. A child that is not there has
/// a box that no ray meets.
struct alignas(64) WideNode {
  /// By axis; lower and upper ends.
  std::array<std::array<std::array<float, node_width>, 2>, 3> ends;
  std::array<ChildRef, node_width> children;
};

/// The boundary cells of a scene under a tree of eight-wide nodes. Cells do not overlap (but for the slack), so the
/// first boundary in the first cell is the answer.
struct CellTree {
  Vec3 center;
  Box3 box;  ///< of the whole solid, absolute
  CellScale scale;
  std::vector<WideNode> nodes;
  std::vector<Cell> cells;
  std::vector<ExtendedCell> extended;  ///< Cell::table is an index into it
  std::vector<Symbol> symbols;
  std::vector<LeafId> extended_leaves;
  PlacedShapes shapes;
  int depth = 0;
  std::uint32_t most_leaves = 0;  ///< in one cell

  std::span<const Symbol> symbols_of(const Cell& cell) const {
    if (!cell.extended) return {};
    const ExtendedCell& e = extended[cell.table];
    return {symbols.data() + e.first_symbol, e.symbol_count};
  }
  std::span<const LeafId> leaves_of(const Cell& cell) const {
    if (!cell.extended) return {cell.leaves.data(), cell.leaf_count};
    const ExtendedCell& e = extended[cell.table];
    return {extended_leaves.data() + e.first_leaf, e.leaf_count};
  }

  bool empty() const { return nodes.empty(); }
  std::size_t memory_bytes() const;
  /// Cells by the number of their leaves, and what else tells a good tree from a bad one.
  std::vector<std::pair<std::string, double>> details() const;

  static CellTree build(const CsgTree& tree, const Box3& box, const BuildQuality& quality, int threads);
};

}  // namespace tenon::cells
