#pragma once

#include <vector>

#include "csg/csg_tree.h"

namespace tenon::cells {

/// All leaves so that those near to each other in space are mostly near in the list: along Morton's curve.
/// @param reach  no bounded coordinate is larger
std::vector<LeafId> spatial_order(const CsgTree& tree, double reach);

}  // namespace tenon::cells
