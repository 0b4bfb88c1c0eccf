#pragma once

#include <cstdint>
#include <vector>

#include "accel/cells/cell_scale.h"
#include "accel/cells/local_expression.h"
#include "csg/csg_tree.h"

namespace tenon::cells {

/// How much work goes into the subdivision.
struct BuildQuality {
  /// Cells with more than one leaf are split, tentatively, until they are this small against the smallest of them.
  double finest = 1.0 / 8;
  int candidates = 1;  ///< evenly spaced planes tried along each axis
};

/// A box in which the solid has a boundary, and the expression there.
struct BoundaryCell {
  Box3 box;
  std::uint32_t first_symbol = 0;  ///< into Subdivision::symbols
  std::uint32_t symbol_count = 0;
  std::uint32_t leaf_count = 0;
};

/// A node of the subdivision: a split plane with a boundary on both sides, or a cell.
struct SubdivisionNode {
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  Box3 box;                   ///< around the cells below
  std::uint32_t cell = none;  ///< none: it is split
  std::uint32_t left = none;
  std::uint32_t right = none;
};

/// Space cut into cells; only those with a boundary are kept.
struct Subdivision {
  std::vector<SubdivisionNode> nodes;
  std::vector<BoundaryCell> cells;
  std::vector<Symbol> symbols;
  std::uint32_t root = SubdivisionNode::none;  ///< none: no boundary anywhere
  int depth = 0;
};

/// Cuts space by planes along the axes until the expression in each cell is as simple as it pays (surface area
/// heuristic on the folded expression, MacDonald & Booth 1990). The same for any number of threads.
///
/// @param box  holds the whole solid
Subdivision subdivide(const CsgTree& tree, const CellScale& scale, const Box3& box, const BuildQuality& quality,
                      int threads);

}  // namespace tenon::cells
