#include "scene/solid_numbers.h"

#include <limits>

namespace tenon {

std::vector<std::uint32_t> solid_numbers(const CsgTree& tree, bool has_section) {
  // The solid's node above each node; a union that only unions lie above has none. Parents come after their children.
  std::vector<CsgNodeId> solid_of(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const CsgNode& node = tree.nodes[i];
    if (node.parent) solid_of[i] = solid_of[node.parent.get()];
    if (has_section && CsgNodeId{i} == tree.root) continue;
    if (!solid_of[i] && node.operation != CsgOperation::union_) solid_of[i] = CsgNodeId{i};
  }
  constexpr std::uint32_t unnumbered = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number_of(tree.nodes.size(), unnumbered);
  std::vector<std::uint32_t> numbers;
  std::uint32_t next = 0;
  for (const Leaf& leaf : tree.leaves) {
    std::uint32_t& number = number_of[solid_of[leaf.node.get()].get()];
    if (number == unnumbered) number = next++;
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace tenon
