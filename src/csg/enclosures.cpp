#include "csg/enclosures.h"

#include <algorithm>

namespace tenon {

double enclosure_margin(const CsgTree& tree) {
  double largest = 0;
  for (const Leaf& leaf : tree.leaves) {
    if (leaf.bounds.is_bounded()) largest = std::max(largest, leaf.bounds.largest_coordinate());
  }
  return 0x1p-32 * largest;
}

std::vector<EnclosedLeaf> enclosed_leaves(const CsgTree& tree, bool minimum) {
  const double margin = enclosure_margin(tree);
  std::vector<Box3> boxes;
  if (minimum) boxes = minimum_enclosures(tree, node_enclosures(tree));
  std::vector<EnclosedLeaf> leaves;
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const Box3& whole = tree.leaves[i].bounds;
    if (!whole.is_bounded()) continue;
    const Box3& box = minimum ? boxes[i] : whole;
    if (!box.is_empty()) leaves.push_back({LeafId{i}, grown(box, margin)});
  }
  return leaves;
}

Box3 hull_of(const std::vector<EnclosedLeaf>& leaves, double margin) {
  Box3 box;
  for (const EnclosedLeaf& l : leaves) box = hull(box, l.box);
  return grown(box, margin);
}

}  // namespace tenon
