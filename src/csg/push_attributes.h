#pragma once

#include "csg/csg_tree.h"
#include "csg/instance_plan.h"
#include "tenon/base/diagnostics.h"
#include "tenon/csg/scene_graph.h"

namespace tenon {

/// Turns the semantic scene graph into a CSG tree over placed primitives: transformations are multiplied down to the
/// leaves, the nearest material and the outermost colour go to each, and attribute nodes dissolve (Zajíček 2012, §2.2,
/// "push attributes step").
///
/// An attribute node with several children becomes their union. Primitives that a map flattens are left out with a
/// warning. Works without recursion, so that no depth of nesting overflows the stack (but for prototypes in
/// prototypes).
///
/// @param plan  which nodes become prototypes: an occurrence of one is a leaf. One that proves to be no solid that can
///              be met as one is spelled out.
CsgTree push_attributes(SceneGraph graph, Diagnostics& diagnostics, const InstancePlan& plan = {});

}  // namespace tenon
