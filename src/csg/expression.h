#pragma once

#include <cstdint>
#include <vector>

#include "csg/csg_tree.h"

namespace tenon {

/// The Boolean expression of a tree, ready to be evaluated leaf by leaf.
///
/// Complements are pushed to the leaves (De Morgan), and operations nested in their own kind are spliced into one, so
/// unions and intersections alternate, n-ary, and a lopsided union is one node. Every node is then a threshold on the
/// number of its true operands: 1 for a union, all of them for an intersection.
struct Expression {
  struct Node {
    std::uint32_t parent = none;
    std::uint32_t threshold = 1;      ///< true operands that make the node true
    std::uint32_t initial_count = 0;  ///< true operands when the point lies outside every primitive
  };
  struct LeafLink {
    std::uint32_t parent = none;
    bool complemented = false;
    bool subtracted = false;  ///< some operation above takes it away, or what it is taken from: it owns nothing
  };
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  std::vector<Node> nodes;       ///< parents come before their operands; the root is nodes[0]
  std::vector<LeafLink> leaves;  ///< by LeafId

  /// Works without recursion.
  static Expression compile(const CsgTree& tree);

  bool initial_value() const { return nodes[0].initial_count >= nodes[0].threshold; }
};

/// One ray's state of an expression: which leaves the current point is in, and so whether it is in the solid.
///
/// Nothing is cleared between rays: counts carry the stamp of the ray that wrote them.
class ExpressionState {
 public:
  explicit ExpressionState(const Expression& expression)
      : expression_(&expression), counts_(expression.nodes.size()), inside_(expression.leaves.size()) {}

  /// A new ray, outside every primitive.
  void reset() {
    if (++stamp_ == 0) {
      for (Count& c : counts_) c.stamp = 0;
      for (std::uint32_t& s : inside_) s = 0;
      stamp_ = 1;
    }
    value_ = expression_->initial_value();
  }

  bool value() const { return value_; }
  bool inside(LeafId leaf) const { return inside_[leaf.get()] == stamp_; }

  /// Crosses the boundary of a leaf. Climbs only while values change.
  /// @return the new value of the root
  bool flip(LeafId leaf) {
    const Expression::LeafLink link = expression_->leaves[leaf.get()];
    const bool now_inside = !inside(leaf);
    inside_[leaf.get()] = now_inside ? stamp_ : 0;
    std::uint32_t node = link.parent;
    bool becomes = now_inside != link.complemented;
    while (node != Expression::none) {
      const Expression::Node& n = expression_->nodes[node];
      std::uint32_t& count = count_of(node, n);
      const bool before = count >= n.threshold;
      if (becomes) {
        ++count;
      } else {
        --count;
      }
      const bool after = count >= n.threshold;
      if (before == after) return value_;
      becomes = after;
      node = n.parent;
    }
    return value_ = becomes;
  }

  /// Whether the point lies in the leaf, the leaf counts as material there (it is not subtracted, nor taken from what
  /// is), and every operation above it is true: the first such leaf in tree order owns the point.
  bool owns(LeafId leaf) const {
    const Expression::LeafLink link = expression_->leaves[leaf.get()];
    if (link.subtracted || !inside(leaf)) return false;
    for (std::uint32_t node = link.parent; node != Expression::none; node = expression_->nodes[node].parent) {
      const Expression::Node& n = expression_->nodes[node];
      const std::uint32_t count = counts_[node].stamp == stamp_ ? counts_[node].value : n.initial_count;
      if (count < n.threshold) return false;
    }
    return true;
  }

 private:
  struct Count {
    std::uint32_t stamp = 0;
    std::uint32_t value = 0;
  };

  std::uint32_t& count_of(std::uint32_t node, const Expression::Node& n) {
    Count& c = counts_[node];
    if (c.stamp != stamp_) c = {stamp_, n.initial_count};
    return c.value;
  }

  const Expression* expression_;
  std::vector<Count> counts_;
  std::vector<std::uint32_t> inside_;  // the stamp of the ray that is inside
  std::uint32_t stamp_ = 0;
  bool value_ = false;
};

}  // namespace tenon
