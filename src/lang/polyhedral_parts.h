#pragma once

#include <optional>
#include <vector>

#include "lang/convex_parts.h"
#include "mesh/convex_cell.h"

namespace tenon::lang {

/// The convex polyhedra that a primitive is the union of, where it has flat faces alone; nothing for others, and for
/// meshes of more than some thousand parts.
std::optional<std::vector<ConvexCell>> polyhedral_parts(const UnionLeaf& leaf);

/// The same of what operations make of such primitives.
std::optional<std::vector<ConvexCell>> polyhedral_parts(const SceneGraph& graph, SceneNodeId id, const Affine3& map);

/// A part as a primitive.
UnionLeaf leaf_of(const ConvexCell& cell);

}  // namespace tenon::lang
