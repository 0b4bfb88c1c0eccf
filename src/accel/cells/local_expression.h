#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/cells/owner_ranks.h"
#include "csg/csg_tree.h"
#include "primitive/local_box.h"

namespace tenon::cells {

/// One symbol of an expression in prefix order: a leaf, or an operation followed by its operands.
struct Symbol {
  enum class Kind : std::uint8_t { leaf, any_of, all_of };

  Kind kind = Kind::leaf;
  bool complemented = false;  ///< of a leaf: its points are outside
  bool is_full = false;       ///< of an any_of: true everywhere; its operands matter to who owns its points
  std::uint32_t size = 1;     ///< symbols up to the end of its last operand, itself included
  LeafId leaf;                ///< none for operations
  Owner owner;  ///< of a leaf: itself, or nobody where it is subtracted; of an operation: who owns its points among
                ///< the operands that were folded away
};

/// A Boolean expression restricted to a region of space: operands that are constant there are folded away (RR-612 §3.2,
/// the projection of a CSG tree, and the inside case, which it lacks).
///
/// Complements stand at the leaves. Which leaf owns a point (its material fills the solid there) is kept for the
/// operands that were folded away. A union that is true keeps the operands that may own points, if these are of another
/// medium then.
using LocalExpression = std::vector<Symbol>;

/// The expression of the whole tree.
LocalExpression whole_expression(const CsgTree& tree, const OwnerRanks& ranks = {});

/// What is left of an expression in a smaller region: a constant and its owner, or an expression that varies.
struct Folded {
  bool constant = false;
  bool value = false;  ///< where it is constant
  Owner owner;
};

/// Folds expressions; keeps its memory between calls.
class Folder {
 public:
  /// @param ranks  as whole_expression() was given; outlives it
  explicit Folder(const OwnerRanks& ranks) : ranks_(ranks) {}

  /// @param region_of  region_of(LeafId) -> Region: where the smaller region lies with respect to a leaf. Not asked of
  ///                   leaves that no longer matter.
  /// @param result     what is left; empty where it is constant. Not the same as `expression`.
  template <class RegionOf>
  Folded fold(std::span<const Symbol> expression, const RegionOf& region_of, LocalExpression& result);

 private:
  // An operation whose operands are being seen.
  struct Frame {
    Symbol::Kind kind;
    bool is_full;
    std::size_t input_end;
    std::size_t output_begin;  // of its own symbol
    std::size_t operands;      // kept so far
    Owner owner;               // among the operands that were folded away
    Owner kept;                // the best that may be among the others
  };
  bool take_constant(bool value, Owner owner, std::size_t& at, LocalExpression& result);
  bool settle_constant(Folded constant, std::size_t& at, LocalExpression& result);
  void finish_operation(LocalExpression& result);

  const OwnerRanks& ranks_;
  std::vector<Frame> frames_;
};

template <class RegionOf>
Folded Folder::fold(std::span<const Symbol> expression, const RegionOf& region_of, LocalExpression& result) {
  result.clear();
  frames_.clear();
  // A frame around the whole, with one operand.
  frames_.push_back({Symbol::Kind::all_of, false, expression.size(), 0, 0, {}, {}});
  for (std::size_t at = 0;;) {
    Frame& frame = frames_.back();
    if (at == frame.input_end) {
      if (frame.operands > 0) {
        if (frames_.size() == 1) return {};
        finish_operation(result);
        continue;
      }
      const bool value = frame.kind == Symbol::Kind::all_of || frame.is_full;
      if (settle_constant({true, value, frame.owner}, at, result)) break;
      continue;
    }
    const Symbol& s = expression[at];
    if (s.kind != Symbol::Kind::leaf) {
      frames_.push_back({s.kind, s.is_full, at + s.size, result.size(), 0, s.owner, {}});
      result.push_back(s);
      ++at;
      continue;
    }
    ++at;
    if (frame.is_full && !(s.owner < frame.owner)) continue;
    const Region region = region_of(s.leaf);
    if (region == Region::straddles) {
      if (frame.is_full && !ranks_.overrides(s.owner, frame.owner)) {
        frame.owner = s.owner.or_worse();
        continue;
      }
      result.push_back(s);
      ++frame.operands;
      frame.kept = std::min(frame.kept, s.owner);
      continue;
    }
    const bool inside = region == Region::inside;
    if (!take_constant(inside != s.complemented, inside ? s.owner : Owner{}, at, result)) continue;
    if (settle_constant({true, false, {}}, at, result)) break;
  }
  result.clear();
  const Frame& whole = frames_.front();
  return {true, whole.operands == 0, whole.owner};
}

/// The value of an expression and who owns the point, for each leaf given whether it holds the point.
/// @param holds  holds(LeafId) -> bool
struct PointValue {
  bool value = false;
  Owner owner;
};

namespace detail {

template <class Holds>
PointValue evaluate_at(std::span<const Symbol> e, std::size_t& at, const Holds& holds) {
  const Symbol& s = e[at++];
  if (s.kind == Symbol::Kind::leaf) {
    const bool inside = holds(s.leaf);
    return {inside != s.complemented, inside ? s.owner : Owner{}};
  }
  const bool all = s.kind == Symbol::Kind::all_of;
  PointValue result{all || s.is_full, s.owner};
  for (const std::size_t end = at - 1 + s.size; at < end;) {
    const PointValue operand = evaluate_at(e, at, holds);
    result.value = all ? result.value && operand.value : result.value || operand.value;
    if (operand.value) result.owner = std::min(result.owner, operand.owner);
  }
  return result;
}

}  // namespace detail

/// For the small expressions of cells: recursive, as deep as the expression.
template <class Holds>
PointValue evaluate(std::span<const Symbol> expression, const Holds& holds) {
  std::size_t at = 0;
  return detail::evaluate_at(expression, at, holds);
}

}  // namespace tenon::cells
