#pragma once

#include <vector>

#include "accel/cells/subdivision.h"
#include "accel/cells/wide_node.h"

namespace tenon::cells {

/// The cells of a whole scene and the nodes above them, the root first; none where there is no boundary at all.
struct BuiltCells {
  CellStore store;
  HugePageVector<WideNode> nodes;
  int depth = 0;
};

/// Cuts space by planes along the axes until the expression in each cell is as simple as it pays (surface area
/// heuristic on the folded expression, MacDonald & Booth 1990). The same for any number of threads.
///
/// Space is cut in parts first, those of one round at the same time. The parts are subdivided by as many threads as
/// there are, some dozens at a time, and added to the whole, so that no more than those exist twice.
///
/// @param box     holds the whole solid
/// @param center  where the coordinates of the nodes' boxes begin
BuiltCells build_cells(const SubdivisionInput& input, const Box3& box, const Vec3& center, int threads);

}  // namespace tenon::cells
