#pragma once

#include <optional>
#include <vector>

#include "lang/convex_parts.h"

namespace tenon::lang {

/// The primitives that a solid is the union of; nothing where other operations make it. What they make of extrusions
/// along one axis counts as one prism, where it is one: a plate with holes. What they make of solids with flat faces
/// counts as its convex parts (polyhedral_parts.h).
std::optional<std::vector<UnionLeaf>> union_leaves(ModuleEvaluator& evaluator, const Solid& solid, Place at);

}  // namespace tenon::lang
