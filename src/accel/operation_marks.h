#pragma once

#include <cstdint>
#include <vector>

#include "accel/operation_tree.h"

namespace tenon {

/// One thread's marks on an operation tree (Zajíček 2012, §2.4), cleared by a new stamp for each ray.
///
/// The thesis asks every child of a marked node for its mark; in a union of 10^5 that costs more than the ray. So a
/// mark links its node into its parent's list of marked children.
class OperationMarks {
 public:
  /// A new ray.
  void start(const OperationTree& tree) {
    tree_ = &tree;
    if (marks_.size() < tree.nodes().size()) marks_.resize(tree.nodes().size());
    root_marked_ = false;
    if (++stamp_ == 0) {
      for (Mark& m : marks_) m.stamp = 0;
      stamp_ = 1;
    }
  }

  /// Marks a leaf, and passes the mark on upward from each operation whose needed operands are all marked.
  /// @return false when the leaf was marked before
  bool mark(std::uint32_t leaf) {
    if (marks_[leaf].stamp == stamp_) return false;
    touch(leaf);
    for (std::uint32_t at = leaf;;) {
      const OperationNode& node = tree_->nodes()[at];
      if (node.parent == OperationNode::none) {
        root_marked_ = true;
        return true;
      }
      Mark& parent = touch(node.parent);
      marks_[at].next_marked = parent.first_marked;
      parent.first_marked = at;
      // The count passes the need once, so no operation is linked twice.
      if (!node.counts || ++parent.marked_operands != tree_->nodes()[node.parent].needed) return true;
      at = node.parent;
    }
  }

  /// Calls `visit(leaf)` for the leaves whose every operation above passed the mark on. The others cannot matter.
  template <class Visit>
  void for_each_leaf(Visit&& visit) {
    if (!root_marked_) return;
    pending_.assign(1, 0);
    while (!pending_.empty()) {
      const std::uint32_t at = pending_.back();
      pending_.pop_back();
      const OperationNode& node = tree_->nodes()[at];
      if (node.is_leaf()) {
        visit(tree_->leaf_of(node));
        continue;
      }
      for (std::uint32_t child = marks_[at].first_marked; child != OperationNode::none;
           child = marks_[child].next_marked) {
        pending_.push_back(child);
      }
    }
  }

 private:
  struct Mark {
    std::uint32_t stamp = 0;
    std::uint32_t marked_operands = 0;  // of those that count
    std::uint32_t first_marked = OperationNode::none;
    std::uint32_t next_marked = OperationNode::none;
  };

  Mark& touch(std::uint32_t node) {
    Mark& mark = marks_[node];
    if (mark.stamp != stamp_) mark = {stamp_, 0, OperationNode::none, OperationNode::none};
    return mark;
  }

  const OperationTree* tree_ = nullptr;
  std::vector<Mark> marks_;
  std::vector<std::uint32_t> pending_;
  std::uint32_t stamp_ = 0;
  bool root_marked_ = false;
};

}  // namespace tenon
