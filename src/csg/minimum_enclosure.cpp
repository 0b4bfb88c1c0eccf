#include "csg/minimum_enclosure.h"

namespace tenon {

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
