#pragma once

#include <cstdint>
#include <vector>

#include "csg/csg_tree.h"

namespace tenon {

/// A node of the operation tree: an operation, or a leaf that stands for a primitive (Zajíček 2012, §2.4). Where the
/// thesis stores a pointer to the function that combines intersections, there is the operation: the classifier
/// combines.
struct OperationNode {
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::uint32_t parent = none;
  std::uint32_t child_count = 0;
  std::uint32_t first_child = 0;  ///< of a leaf: the LeafId
  /// How many of the operands that count must be marked for the operation to matter.
  std::uint32_t needed = 1;
  CsgOperation operation = CsgOperation::union_;
  /// Empty along a ray that misses every bounded primitive below it.
  bool empty_unless_marked = true;
  bool counts = true;  ///< it is among the operands that its parent needs

  bool is_leaf() const { return operation == CsgOperation::leaf; }
};

/// The pure Boolean operations of a scene in one sequential array, the children of a node next to each other and after
/// it. Operations nested in their own kind are one node ((a - b) - c is a - b - c, and a - (b ∪ c) too), so that a
/// lopsided model makes no deep tree; the thesis leaves out "non-essential nodes" without naming them.
class OperationTree {
 public:
  /// Works without recursion.
  /// @param skip  an operation matters only when the operands without which it is empty are marked: a minuend, every
  ///              operand of an intersection. Without, any mark below it will do, as in the thesis's pseudo code.
  explicit OperationTree(const CsgTree& tree, bool skip = true);

  const std::vector<OperationNode>& nodes() const { return nodes_; }
  bool empty() const { return nodes_.empty(); }
  /// The node of a leaf; none where the leaf stands under no operation that is left.
  std::uint32_t node_of(LeafId leaf) const { return node_of_leaf_[leaf.get()]; }
  LeafId leaf_of(const OperationNode& node) const { return LeafId{node.first_child}; }
  std::size_t memory_bytes() const {
    return nodes_.capacity() * sizeof(OperationNode) + node_of_leaf_.capacity() * sizeof(std::uint32_t);
  }

 private:
  void add_operands(const CsgTree& tree, CsgNodeId from, std::uint32_t to);
  void find_needs(const CsgTree& tree, bool skip);

  std::vector<OperationNode> nodes_;
  std::vector<std::uint32_t> node_of_leaf_;
  std::vector<CsgNodeId> sources_;  // while building: the CSG node of each node
};

}  // namespace tenon
