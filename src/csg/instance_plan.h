#pragma once

#include <vector>

#include "tenon/csg/scene_graph.h"

namespace tenon {

/// Which nodes of a scene graph are stored once however often they occur (Prototype). A tree of placed leaves is traced
/// faster, so none are as long as the whole tree is no larger than told.
struct InstancePlan {
  std::vector<bool> is_prototype;    ///< by SceneNodeId; empty: none
  std::vector<bool> has_materials;   ///< by SceneNodeId: below it stand colours or materials
  std::vector<bool> is_transparent;  ///< by MaterialId
  double leaves = 0;                 ///< of the tree, instances among them, if all are as planned

  bool stores(SceneNodeId node) const { return !is_prototype.empty() && is_prototype[node.get()]; }
};

/// Chooses the nodes nearest to the root that occur more than once and make up a good part of the tree; within one that
/// is itself larger than told, others again. What is surface, or shows what it cuts, or is transparent by a material of
/// its own, is no prototype.
///
/// @param is_transparent  by MaterialId
/// @param most_leaves     of the whole tree, up to which nothing is stored once
InstancePlan plan_instances(const SceneGraph& graph, std::vector<bool> is_transparent, double most_leaves);

}  // namespace tenon
