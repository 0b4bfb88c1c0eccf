#pragma once

#include <cstdint>
#include <vector>

#include "csg/csg_tree.h"

namespace tenon {

/// Which solid each leaf is a part of. The solids of a scene are the largest parts of its tree that are no unions,
/// numbered from 0 in tree order; a tool counts to the solid it cuts. Indexed by LeafId.
std::vector<std::uint32_t> solid_numbers(const CsgTree& tree);

}  // namespace tenon
