#pragma once

#include <span>

#include "csg/csg_tree.h"
#include "tenon/base/error.h"
#include "tenon/scene/section.h"

namespace tenon {

/// Takes the parts that cuts take away from a tree, as a difference at its root. The planes become half-spaces, the
/// last leaves of the tree, which own no point: so every rule for coinciding faces, cut faces and media holds for them.
/// @return the first leaf that is a plane of a cut, none without cuts; or an input error about a plane
Result<LeafId> cut_tree(CsgTree& tree, std::span<const SectionCut> cuts);

}  // namespace tenon
