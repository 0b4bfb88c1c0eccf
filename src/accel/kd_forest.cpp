#include "accel/kd_forest.h"

#include "primitive/dispatch.h"

namespace tenon {

KdForest::KdForest(const CsgTree& tree, const OperationTree& operations, const KdOptions& options)
    : options_(options), operations_(operations.nodes().size()) {
  find_boxes(tree, operations);
  add_tree(operations, 0, operations.empty() ? 0 : 1);
  for (std::uint32_t i = 0; i < operations_.size(); ++i) {
    const OperationNode& node = operations.nodes()[i];
    const std::uint32_t first = node.first_child, last = first + node.child_count;
    operations_[i].first_operand = static_cast<std::uint32_t>(operands_.size());
    if (boxes_[i].is_empty()) continue;
    if (node.operation == CsgOperation::difference) {
      add_operand(operations, first, first + 1, operations.nodes()[first].empty_unless_marked);
      add_operand(operations, first + 1, last, false);
    } else if (node.operation == CsgOperation::intersection) {
      for (std::uint32_t child = first; child < last; ++child) {
        add_operand(operations, child, child + 1, operations.nodes()[child].empty_unless_marked);
      }
    }
    operations_[i].operand_count = static_cast<std::uint32_t>(operands_.size()) - operations_[i].first_operand;
  }
  boxes_ = {};
  costs_ = {};
  trees_.shrink_to_fit();
  operands_.shrink_to_fit();
}

void KdForest::find_boxes(const CsgTree& tree, const OperationTree& operations) {
  boxes_.resize(operations.nodes().size());
  costs_.resize(operations.nodes().size());
  for (const EnclosedLeaf& l : enclosed_leaves(tree)) {
    const std::uint32_t node = operations.node_of(l.leaf);
    boxes_[node] = l.box;
    costs_[node] = cost(tree.primitives, tree[l.leaf].primitive);
  }
  // Children come after their parents.
  for (std::size_t i = boxes_.size(); i-- > 1;) {
    const std::uint32_t parent = operations.nodes()[i].parent;
    boxes_[parent] = hull(boxes_[parent], boxes_[i]);
    costs_[parent] += costs_[i];
  }
}

void KdForest::add_operand(const OperationTree& operations, std::uint32_t first, std::uint32_t last, bool needed) {
  operands_.push_back({static_cast<std::uint32_t>(trees_.size()), needed});
  add_tree(operations, first, last);
}

// A tree over what the nodes from `first` to `last` give once their unions and complements are dissolved.
void KdForest::add_tree(const OperationTree& operations, std::uint32_t first, std::uint32_t last) {
  std::vector<KdItem> items;
  std::vector<std::uint32_t> pending;
  for (std::uint32_t i = first; i < last; ++i) pending.push_back(i);
  while (!pending.empty()) {
    const std::uint32_t at = pending.back();
    pending.pop_back();
    if (boxes_[at].is_empty()) continue;
    const OperationNode& node = operations.nodes()[at];
    if (node.operation == CsgOperation::union_ || node.operation == CsgOperation::complement) {
      for (std::uint32_t i = 0; i < node.child_count; ++i) pending.push_back(node.first_child + i);
    } else {
      items.push_back({at, boxes_[at], costs_[at]});
    }
  }
  trees_.push_back(build_kd_tree(items, options_));
}

std::size_t KdForest::memory_bytes() const {
  std::size_t bytes = trees_.capacity() * sizeof(KdTree) + operands_.capacity() * sizeof(Operand) +
                      operations_.capacity() * sizeof(Operation);
  for (const KdTree& tree : trees_) bytes += tree.memory_bytes();
  return bytes;
}

}  // namespace tenon
