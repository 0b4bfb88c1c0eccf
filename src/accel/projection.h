#pragma once

#include <cstdint>
#include <vector>

#include "csg/csg_tree.h"
#include "tenon/math/box3.h"

namespace tenon {

/// A part of an expression in postfix order: operands come before the operation.
struct SubtreeToken {
  enum class Kind : std::uint8_t { leaf, complemented_leaf, union_, intersection, everything };
  Kind kind = Kind::leaf;
  std::uint32_t value = 0;  ///< of a leaf: its id; of an operation: the number of its operands

  bool is_leaf() const { return kind == Kind::leaf || kind == Kind::complemented_leaf; }
  LeafId leaf() const { return LeafId{value}; }
  friend constexpr bool operator==(const SubtreeToken&, const SubtreeToken&) = default;
};

/// A CSG tree restricted to some of its primitives. Without tokens it is RR-612's null: the solid is not there.
using Subtree = std::vector<SubtreeToken>;

/// The whole tree, with complements pushed to the leaves (Expression).
Subtree subtree_of(const CsgTree& tree);
/// The leaves without any operation between them: a list whose projection drops nothing but what is not in the box.
Subtree subtree_of(const std::vector<LeafId>& leaves);

/// Projects a CSG tree on a box (RR-612 §3.2).
///
/// The paper's rules are for binary union, difference and intersection. A - B is A and not B here, so a leaf that is
/// not in the box is null, or everything when it is complemented, and the rules become: a union drops null operands and
/// is everything when one operand is; an intersection drops operands that are everything and is null when one is. That
/// is the paper's table, and holds for n operands and for complements, which it does not have.
///
/// In the box the projected tree has the value of the whole tree: only constants were folded. A leaf that the
/// projection drops therefore cannot change the root there, whatever its state, so that a classifier of the whole tree
/// to which it was not revealed has the same value.
///
/// With media a union that is everything keeps its other operands: they own the points they hold.
class Projection {
 public:
  /// @param enclosures  by LeafId: where each leaf can matter; empty for a leaf that never does, Box3::everything() for
  ///                    an unbounded one
  Projection(std::vector<Box3> enclosures, bool has_media)
      : enclosures_(std::move(enclosures)), has_media_(has_media) {}

  const Box3& enclosure(LeafId leaf) const { return enclosures_[leaf.get()]; }

  /// The tree projected on the box. Costs its length, and no depth of nesting needs a deep call stack.
  Subtree project(const Subtree& tree, const Box3& box);

  /// The bounded leaves of a subtree. Unbounded ones are in every box, so no structure keeps them.
  std::size_t count_primitives(const Subtree& tree) const;
  bool is_bounded(LeafId leaf) const { return enclosure(leaf).is_bounded(); }

  /// A box around the part of the subtree's solid that lies in `box` (RR-612 §3.3, `penclosure`). Outside it the
  /// subtree is false even when leaves of it that the point lies in are unknown: it relies on no complemented leaf.
  Box3 enclose(const Subtree& tree, const Box3& box);

 private:
  void project_union(Subtree& out, std::size_t operands);
  void project_intersection(Subtree& out, std::size_t operands);

  std::vector<Box3> enclosures_;
  bool has_media_;
  std::vector<std::size_t> starts_;  // where the operands still to be combined begin
  std::vector<Box3> boxes_;
};

}  // namespace tenon
