#pragma once

#include <cstdint>
#include <vector>

#include "csg/csg_tree.h"

namespace tenon {

/// Which solid each leaf is a part of. The solids of a scene are the largest parts of its tree that are no unions,
/// numbered from 0 in tree order; a tool counts to the solid it cuts. What a section view takes away counts as solids
/// of its own, after the others. Indexed by LeafId.
/// @param has_section  the tree's root is the difference of the scene and the cuts of a section view
std::vector<std::uint32_t> solid_numbers(const CsgTree& tree, bool has_section);

}  // namespace tenon
