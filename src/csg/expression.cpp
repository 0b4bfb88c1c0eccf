#include "csg/expression.h"

namespace tenon {

namespace {

// A CSG node that still has to be attached to the expression, complemented or not.
struct Pending {
  CsgNodeId node;
  bool complemented;
  bool subtracted;
  std::uint32_t parent;
};

enum class Kind : std::uint8_t { union_, intersection };

class Compiler {
 public:
  explicit Compiler(const CsgTree& tree) : tree_(tree) { expression_.leaves.resize(tree.leaves.size()); }

  Expression run() {
    add_node(Kind::union_, Expression::none);
    if (tree_.root) pending_.push_back({tree_.root, false, false, 0});
    while (!pending_.empty()) {
      const Pending next = pending_.back();
      pending_.pop_back();
      attach(next);
    }
    set_thresholds();
    set_initial_counts();
    return std::move(expression_);
  }

 private:
  std::uint32_t add_node(Kind kind, std::uint32_t parent) {
    if (parent != Expression::none) ++operand_count_[parent];
    expression_.nodes.push_back({parent, 1, 0});
    kinds_.push_back(kind);
    operand_count_.push_back(0);
    return static_cast<std::uint32_t>(expression_.nodes.size() - 1);
  }

  void attach(const Pending& p) {
    const CsgNode& node = tree_[p.node];
    const auto children = tree_.children_of(node);
    switch (node.operation) {
      case CsgOperation::leaf:
        expression_.leaves[node.leaf.get()] = {p.parent, p.complemented, p.subtracted};
        ++operand_count_[p.parent];
        return;
      case CsgOperation::complement:
        attach_complement(p, children.front());
        return;
      case CsgOperation::union_:
      case CsgOperation::intersection:
      case CsgOperation::difference:
        break;
    }
    // De Morgan: the complement of a union is the intersection of the complements, and so on.
    const bool is_union = (node.operation == CsgOperation::union_) != p.complemented;
    const Kind kind = is_union ? Kind::union_ : Kind::intersection;
    const bool splice = kind == kinds_[p.parent];
    const std::uint32_t parent = splice ? p.parent : add_node(kind, p.parent);
    // Pushed in reverse, so that the first operand is attached first.
    for (std::size_t i = children.size(); i-- > 0;) {
      const bool subtracted = node.operation == CsgOperation::difference && i > 0;
      pending_.push_back({children[i], p.complemented != subtracted, p.subtracted || subtracted, parent});
    }
  }

  // The complement of a complement is what it was.
  void attach_complement(const Pending& p, CsgNodeId child) {
    const CsgNode& node = tree_[child];
    if (node.operation == CsgOperation::complement) {
      pending_.push_back({tree_.children_of(node).front(), p.complemented, p.subtracted, p.parent});
    } else {
      pending_.push_back({child, !p.complemented, true, p.parent});
    }
  }

  void set_thresholds() {
    for (std::size_t i = 0; i < expression_.nodes.size(); ++i) {
      if (kinds_[i] == Kind::intersection) expression_.nodes[i].threshold = operand_count_[i];
    }
  }

  // Outside every primitive exactly the complemented leaves are true. Operands come after their parents.
  void set_initial_counts() {
    for (const Expression::LeafLink& leaf : expression_.leaves) {
      if (leaf.parent != Expression::none && leaf.complemented) ++expression_.nodes[leaf.parent].initial_count;
    }
    for (std::size_t i = expression_.nodes.size(); i-- > 1;) {
      const Expression::Node& node = expression_.nodes[i];
      if (node.initial_count >= node.threshold) ++expression_.nodes[node.parent].initial_count;
    }
  }

  const CsgTree& tree_;
  Expression expression_;
  std::vector<Kind> kinds_;
  std::vector<std::uint32_t> operand_count_;
  std::vector<Pending> pending_;
};

}  // namespace

Expression Expression::compile(const CsgTree& tree) {
  return Compiler(tree).run();
}

}  // namespace tenon
