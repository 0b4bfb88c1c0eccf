#include "accel/operation_tree.h"

#include <algorithm>

namespace tenon {

namespace {

// An operand of a CSG node that may have to be replaced by its own operands.
struct Operand {
  CsgNodeId node;
  bool subtracted;
};

// Whether an operand's own operands can stand in its place.
bool dissolves(const CsgNode& operand, CsgOperation operation, bool subtracted, std::size_t place) {
  switch (operand.operation) {
    case CsgOperation::union_:
      return operation == CsgOperation::union_ || operation == CsgOperation::complement || subtracted;
    case CsgOperation::intersection:
      return operation == CsgOperation::intersection;
    case CsgOperation::difference:
      return operation == CsgOperation::difference && place == 0 && operand.child_count > 0;
    case CsgOperation::leaf:
    case CsgOperation::complement:
      return false;
  }
  return false;
}

}  // namespace

OperationTree::OperationTree(const CsgTree& tree, bool skip) : node_of_leaf_(tree.leaves.size(), OperationNode::none) {
  if (!tree.root) return;
  nodes_.emplace_back();
  sources_.push_back(tree.root);
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    const CsgNode& source = tree[sources_[i]];
    nodes_[i].operation = source.operation;
    if (source.operation == CsgOperation::leaf) {
      nodes_[i].first_child = source.leaf.get();
      node_of_leaf_[source.leaf.get()] = i;
    } else {
      add_operands(tree, sources_[i], i);
    }
  }
  sources_ = {};
  find_needs(tree, skip);
  nodes_.shrink_to_fit();
}

void OperationTree::add_operands(const CsgTree& tree, CsgNodeId from, std::uint32_t to) {
  nodes_[to].first_child = static_cast<std::uint32_t>(nodes_.size());
  const CsgOperation operation = tree[from].operation;
  std::vector<Operand> pending{{from, false}};
  std::size_t place = 0;
  while (!pending.empty()) {
    const Operand next = pending.back();
    pending.pop_back();
    const CsgNode& node = tree[next.node];
    if (next.node != from && !dissolves(node, operation, next.subtracted, place)) {
      OperationNode operand;
      operand.parent = to;
      nodes_.push_back(operand);
      sources_.push_back(next.node);
      ++place;
      continue;
    }
    // Pushed in reverse, so that the first operand stays first.
    const auto children = tree.children_of(node);
    for (std::size_t i = children.size(); i-- > 0;) {
      const bool subtracted = next.subtracted || (node.operation == CsgOperation::difference && i > 0);
      pending.push_back({children[i], subtracted});
    }
  }
  nodes_[to].child_count = static_cast<std::uint32_t>(place);
}

void OperationTree::find_needs(const CsgTree& tree, bool skip) {
  // Children come after their parents, so going backwards meets every child first.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    OperationNode& node = nodes_[i];
    if (node.is_leaf()) {
      node.empty_unless_marked = tree[leaf_of(node)].bounds.is_bounded();
      continue;
    }
    OperationNode* const first = nodes_.data() + node.first_child;
    OperationNode* const last = first + node.child_count;
    const auto empty = [](const OperationNode& n) { return n.empty_unless_marked; };
    switch (node.operation) {
      case CsgOperation::leaf:
      case CsgOperation::union_:
        node.empty_unless_marked = std::all_of(first, last, empty);
        break;
      case CsgOperation::complement:
        node.empty_unless_marked = false;
        break;
      case CsgOperation::difference:
        node.empty_unless_marked = first == last || first->empty_unless_marked;
        if (skip && node.empty_unless_marked) {
          for (OperationNode* child = first; child != last; ++child) child->counts = child == first;
        }
        break;
      case CsgOperation::intersection: {
        const auto needed = std::count_if(first, last, empty);
        node.empty_unless_marked = needed > 0;
        if (!skip || needed == 0) break;
        node.needed = static_cast<std::uint32_t>(needed);
        for (OperationNode* child = first; child != last; ++child) child->counts = child->empty_unless_marked;
        break;
      }
    }
  }
}

}  // namespace tenon
