#include "csg/minimum_enclosure.h"

#include <algorithm>
#include <cmath>

namespace tenon {

namespace {

// The only unbounded primitive is the half-space; one along an axis fills its bounds, which have one end. What is left
// when it is subtracted lies beyond that end. Bounds are rounded outward, so this cuts by their rounding too deep,
// which is far less than what structures grow enclosures by.
void cut_by_half_space(const Box3& bounds, Box3& enclosure) {
  int ends = 0;
  for (int axis = 0; axis < 3; ++axis) ends += std::isfinite(bounds.lower[axis]) + std::isfinite(bounds.upper[axis]);
  if (ends != 1) return;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(bounds.lower[axis])) {
      enclosure.upper[axis] = std::min(enclosure.upper[axis], bounds.lower[axis]);
    } else if (std::isfinite(bounds.upper[axis])) {
      enclosure.lower[axis] = std::max(enclosure.lower[axis], bounds.upper[axis]);
    }
  }
  if (enclosure.is_empty()) enclosure = Box3::empty();
}

}  // namespace

std::vector<Box3> node_enclosures(const CsgTree& tree) {
  std::vector<Box3> leaf_boxes;
  for (const Leaf& leaf : tree.leaves) leaf_boxes.push_back(leaf.bounds);
  return node_enclosures(tree, leaf_boxes);
}

std::vector<Box3> node_enclosures(const CsgTree& tree, const std::vector<Box3>& leaf_boxes) {
  std::vector<Box3> enclosure(tree.nodes.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const CsgNode& node = tree.nodes[i];
    const auto children = tree.children_of(node);
    switch (node.operation) {
      case CsgOperation::leaf:
        enclosure[i] = leaf_boxes[node.leaf.get()];
        break;
      case CsgOperation::union_:
        for (const CsgNodeId child : children) enclosure[i] = hull(enclosure[i], enclosure[child.get()]);
        break;
      case CsgOperation::intersection:
        enclosure[i] = enclosure[children.front().get()];
        for (const CsgNodeId child : children) enclosure[i] = intersection(enclosure[i], enclosure[child.get()]);
        break;
      case CsgOperation::difference:
        enclosure[i] = enclosure[children.front().get()];
        for (const CsgNodeId tool : children.subspan(1)) {
          const CsgNode& node_of_tool = tree[tool];
          if (node_of_tool.operation != CsgOperation::leaf) continue;
          cut_by_half_space(leaf_boxes[node_of_tool.leaf.get()], enclosure[i]);
        }
        break;
      case CsgOperation::complement:
        enclosure[i] = Box3::everything();
        break;
    }
  }
  return enclosure;
}

std::vector<Box3> minimum_enclosures(const CsgTree& tree, const std::vector<Box3>& enclosures) {
  std::vector<Box3> used = enclosures;
  std::vector<Box3> minimum(tree.leaves.size());
  // Parents come after their children, so going backwards meets every parent first.
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const CsgNode& node = tree.nodes[i];
    if (node.parent) used[i] = intersection(used[i], used[node.parent.get()]);
    if (node.operation == CsgOperation::leaf) minimum[node.leaf.get()] = used[i];
  }
  return minimum;
}

}  // namespace tenon
