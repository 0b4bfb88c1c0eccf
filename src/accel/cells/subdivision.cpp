#include "accel/cells/subdivision.h"

#include "accel/cells/cell_cost.h"

namespace tenon::cells {

Subdivision::Built Subdivision::join(const Built& left, const Built& right) {
  if (left.node == SubdivisionNode::none) return right;
  if (right.node == SubdivisionNode::none) return left;
  const std::uint32_t node = join(left.node, right.node);
  return {node, left.cost + right.cost + nodes[node].box.surface_area() * CellCost::split};
}

}  // namespace tenon::cells
