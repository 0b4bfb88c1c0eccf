#include "csg/instance_plan.h"

#include <utility>

#include "primitive/dispatch.h"

namespace tenon {

namespace {

// What a node holds, counted as if it were a tree.
struct Content {
  double leaves = 0;  // may be far more than any integer holds
  bool is_fit = true;
  bool has_materials = false;
};

Content content_of(const SceneGraph& graph, const SceneNode& node, const std::vector<Content>& of,
                   const std::vector<bool>& is_transparent) {
  Content content;
  if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
    content.leaves = 1;
    content.is_fit =
        !is_surface(graph.primitives, leaf->primitive) && face_count(graph.primitives, leaf->primitive).has_value();
  } else if (const auto* color = std::get_if<ColorAttribute>(&node.content)) {
    content.has_materials = true;
    content.is_fit = color->color.a >= 1;
  } else if (const auto* material = std::get_if<MaterialAttribute>(&node.content)) {
    content.has_materials = true;
    content.is_fit = !is_transparent[material->material.get()];
  } else if (std::holds_alternative<CutFacesAttribute>(node.content)) {
    content.is_fit = false;
  }
  for (const SceneNodeId child : node.children) {
    const Content& below = of[child.get()];
    content.leaves += below.leaves;
    content.is_fit &= below.is_fit;
    content.has_materials |= below.has_materials;
  }
  return content;
}

// Of the tree that takes prototypes for leaves.
double count_leaves(const SceneGraph& graph, const std::vector<bool>& is_prototype) {
  double leaves = 0;
  std::vector<double> occurrences(graph.nodes.size());
  occurrences[graph.root.get()] = 1;
  for (std::size_t i = graph.root.get() + std::size_t{1}; i-- > 0;) {
    const bool is_leaf = is_prototype[i] || std::holds_alternative<PrimitiveLeaf>(graph.nodes[i].content);
    if (is_leaf) {
      leaves += occurrences[i];
    } else {
      for (const SceneNodeId child : graph.nodes[i].children) occurrences[child.get()] += occurrences[i];
    }
  }
  return leaves;
}

}  // namespace

InstancePlan plan_instances(const SceneGraph& graph, std::vector<bool> is_transparent, double most_leaves) {
  InstancePlan plan;
  if (!graph.root) return plan;
  std::vector<Content> content;
  content.reserve(graph.nodes.size());
  for (const SceneNode& node : graph.nodes) content.push_back(content_of(graph, node, content, is_transparent));
  plan.leaves = content[graph.root.get()].leaves;
  if (plan.leaves <= most_leaves) return plan;

  // An instance costs what a few leaves do, and a subtree that is a small part of the whole saves little.
  constexpr double least_leaves = 3, least_share = 1.0 / 16;
  plan.is_prototype.resize(graph.nodes.size());
  plan.is_transparent = std::move(is_transparent);
  for (const Content& c : content) plan.has_materials.push_back(c.has_materials);
  // Parents come after their children. How often each node occurs where no prototype has been chosen above it.
  std::vector<double> occurrences(graph.nodes.size());
  occurrences[graph.root.get()] = 1;
  for (std::size_t i = graph.root.get() + std::size_t{1}; i-- > 0;) {
    const Content& c = content[i];
    double within = occurrences[i];
    if (c.is_fit && within >= 2 && c.leaves >= least_leaves && within * c.leaves > least_share * most_leaves) {
      plan.is_prototype[i] = true;
      within = c.leaves > most_leaves ? 1 : 0;
    }
    if (within == 0) continue;
    for (const SceneNodeId child : graph.nodes[i].children) occurrences[child.get()] += within;
  }
  plan.leaves = count_leaves(graph, plan.is_prototype);
  return plan;
}

}  // namespace tenon
