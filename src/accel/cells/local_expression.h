#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "csg/csg_tree.h"
#include "primitive/local_box.h"

namespace tenon::cells {

/// Who owns the solid's points of a region: a leaf, nobody, or different leaves at different points.
struct Owner {
  static constexpr std::uint32_t nobody = ~std::uint32_t{0};
  static constexpr std::uint32_t varies = nobody - 1;

  std::uint32_t value = nobody;

  /// Of two operands that are both true: the first in tree order. One that varies may come before the other or not.
  static constexpr Owner first(Owner a, Owner b) {
    if (a.value == nobody) return b;
    if (b.value == nobody) return a;
    if (a.value == varies || b.value == varies) return {varies};
    return {std::min(a.value, b.value)};
  }
  friend constexpr bool operator==(Owner, Owner) = default;
};

/// One symbol of an expression in prefix order: a leaf, or an operation followed by its operands.
struct Symbol {
  enum class Kind : std::uint8_t { leaf, any_of, all_of };

  Kind kind = Kind::leaf;
  bool complemented = false;  ///< of a leaf: its points are outside
  std::uint32_t size = 1;     ///< symbols up to the end of its last operand, itself included
  LeafId leaf;                ///< none for operations
  Owner owner;                ///< of an all_of: who owns its points among the operands that were folded away
};

/// A Boolean expression restricted to a region of space: operands that are constant there are folded away (RR-612 §3.2,
/// the projection of a CSG tree, and the inside case, which it lacks).
///
/// Complements stand at the leaves. Which leaf owns a point (its material fills the solid there) is kept for the
/// operands that were folded away.
using LocalExpression = std::vector<Symbol>;

/// The expression of the whole tree.
LocalExpression whole_expression(const CsgTree& tree);

/// What is left of an expression in a smaller region: a constant and its owner, or an expression that varies.
struct Folded {
  bool constant = false;
  bool value = false;  ///< where it is constant
  Owner owner;
};

/// Folds expressions; keeps its memory between calls.
class Folder {
 public:
  /// @param region_of  region_of(LeafId) -> Region: where the smaller region lies with respect to a leaf. Not asked of
  ///                   leaves that no longer matter.
  /// @param result     what is left; empty where it is constant. Not the same as `expression`.
  template <class RegionOf>
  Folded fold(std::span<const Symbol> expression, const RegionOf& region_of, LocalExpression& result);

 private:
  struct Frame {
    Symbol::Kind kind;
    std::size_t input_end;
    std::size_t output_begin;  // of its own symbol
    std::size_t operands;
    Owner owner;
  };
  bool take_constant(bool value, Owner owner);
  bool settle_constant(Folded constant, std::size_t& at, LocalExpression& result);
  void finish_operation(LocalExpression& result);

  std::vector<Frame> frames_;
};

template <class RegionOf>
Folded Folder::fold(std::span<const Symbol> expression, const RegionOf& region_of, LocalExpression& result) {
  result.clear();
  frames_.clear();
  // A frame around the whole, with one operand.
  frames_.push_back({Symbol::Kind::all_of, expression.size(), 0, 0, {}});
  for (std::size_t at = 0;;) {
    Frame& frame = frames_.back();
    if (at == frame.input_end) {
      if (frame.operands > 0) {
        if (frames_.size() == 1) return {};
        finish_operation(result);
        continue;
      }
      if (settle_constant({true, frame.kind == Symbol::Kind::all_of, frame.owner}, at, result)) break;
      continue;
    }
    const Symbol& s = expression[at];
    if (s.kind != Symbol::Kind::leaf) {
      frames_.push_back({s.kind, at + s.size, result.size(), 0, s.owner});
      result.push_back(s);
      ++at;
      continue;
    }
    ++at;
    const Region region = region_of(s.leaf);
    if (region == Region::straddles) {
      result.push_back(s);
      ++frame.operands;
      continue;
    }
    const bool inside = region == Region::inside;
    const Owner owner = inside && !s.complemented ? Owner{s.leaf.get()} : Owner{};
    if (!take_constant(inside != s.complemented, owner)) continue;
    if (settle_constant({true, frame.kind == Symbol::Kind::any_of, frame.owner}, at, result)) break;
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
    return {inside != s.complemented, inside && !s.complemented ? Owner{s.leaf.get()} : Owner{}};
  }
  const bool all = s.kind == Symbol::Kind::all_of;
  PointValue result{all, s.owner};
  for (const std::size_t end = at - 1 + s.size; at < end;) {
    const PointValue operand = evaluate_at(e, at, holds);
    result.value = all ? result.value && operand.value : result.value || operand.value;
    if (operand.value) result.owner = Owner::first(result.owner, operand.owner);
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
