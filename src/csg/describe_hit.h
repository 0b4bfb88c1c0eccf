#pragma once

#include "csg/csg_tree.h"
#include "tenon/csg/hit.h"
#include "tenon/math/ray.h"

namespace tenon {

/// Gives a hit whose run is known (t, surface, is_surface, before, after) what that means in the world: point, normal,
/// material, and whether the ray enters the solid there. See make_hit().
/// @param leaf_entering, owner  as in Run
void describe_hit(const CsgTree& tree, const Ray& ray, bool leaf_entering, LeafId owner, Hit& hit);

/// Whether the material there may be that of the owner, and not that of the leaf that shows.
bool shows_owner(const Leaf& leaf, MediumId before, MediumId after);

}  // namespace tenon
