#include "accel/cells/local_expression.h"

#include <algorithm>

#include "csg/expression.h"

namespace tenon::cells {

LocalExpression whole_expression(const CsgTree& tree, const OwnerRanks& ranks) {
  // The compiled expression knows parents; what is wanted here is operands, in tree order.
  const Expression compiled = Expression::compile(tree);
  struct Operand {
    std::uint32_t first_leaf;  // orders the operands of a node
    std::uint32_t index;
    bool is_leaf;
  };
  std::vector<std::vector<Operand>> operands(compiled.nodes.size());
  std::vector<std::uint32_t> first_leaf(compiled.nodes.size(), Expression::none);
  for (std::uint32_t i = 0; i < compiled.leaves.size(); ++i) {
    const std::uint32_t parent = compiled.leaves[i].parent;
    if (parent == Expression::none) continue;
    operands[parent].push_back({i, i, true});
    first_leaf[parent] = std::min(first_leaf[parent], i);
  }
  // Parents come before their operands, so backwards every node is complete when its parent asks.
  for (std::uint32_t i = static_cast<std::uint32_t>(compiled.nodes.size()); i-- > 1;) {
    const std::uint32_t parent = compiled.nodes[i].parent;
    operands[parent].push_back({first_leaf[i], i, false});
    first_leaf[parent] = std::min(first_leaf[parent], first_leaf[i]);
  }
  for (auto& list : operands) {
    std::stable_sort(list.begin(), list.end(),
                     [](const Operand& a, const Operand& b) { return a.first_leaf < b.first_leaf; });
  }

  LocalExpression result;
  struct Open {
    std::uint32_t node;
    std::size_t next;
    std::size_t begin;
  };
  std::vector<Open> open;
  const auto begin_node = [&](std::uint32_t node) {
    const bool all = compiled.nodes[node].threshold != 1 || operands[node].size() == 1;
    open.push_back({node, 0, result.size()});
    Symbol symbol;
    symbol.kind = all ? Symbol::Kind::all_of : Symbol::Kind::any_of;
    result.push_back(symbol);
  };
  begin_node(0);
  while (!open.empty()) {
    Open& top = open.back();
    if (top.next == operands[top.node].size()) {
      result[top.begin].size = static_cast<std::uint32_t>(result.size() - top.begin);
      open.pop_back();
      continue;
    }
    const Operand operand = operands[top.node][top.next++];
    if (!operand.is_leaf) {
      begin_node(operand.index);
      continue;
    }
    Symbol leaf;
    leaf.complemented = compiled.leaves[operand.index].complemented;
    leaf.leaf = LeafId{operand.index};
    if (!compiled.leaves[operand.index].subtracted) leaf.owner = ranks.owner(leaf.leaf);
    result.push_back(leaf);
  }
  return result;
}

// Takes a constant operand into the innermost operation.
// @return whether that makes the operation false
bool Folder::take_constant(bool value, Owner owner, std::size_t& at, LocalExpression& result) {
  Frame& frame = frames_.back();
  if (frame.kind == Symbol::Kind::all_of) {
    if (value) frame.owner = std::min(frame.owner, owner);
    return !value;
  }
  if (!value) return false;
  frame.is_full = true;
  frame.owner = std::min(frame.owner, owner);
  if (!ranks_.overrides(frame.kept, frame.owner)) {
    result.resize(frame.output_begin + 1);
    frame.operands = 0;
    if (frame.kept < frame.owner) frame.owner = frame.kept.or_worse();
    frame.kept = {};
  }
  // What follows is of a worse rank.
  if (ranks_.is_tree_order() && !frame.owner.is_nobody()) at = frame.input_end;
  return false;
}

// The innermost operation is constant: it leaves, and its value is taken outward until something is still open.
// @return whether the whole is constant; its value is then told by the outermost frame, whose count of operands is 0
//         for true
bool Folder::settle_constant(Folded constant, std::size_t& at, LocalExpression& result) {
  for (;;) {
    const Frame done = frames_.back();
    if (frames_.size() == 1) {
      frames_.front().operands = constant.value ? 0 : 1;
      frames_.front().owner = constant.owner;
      return true;
    }
    result.resize(done.output_begin);
    at = done.input_end;
    frames_.pop_back();
    if (!take_constant(constant.value, constant.value ? constant.owner : Owner{}, at, result)) return false;
    constant = {true, false, {}};
  }
}

// The innermost operation varies, or who owns its points does, and all its operands have been seen.
void Folder::finish_operation(LocalExpression& result) {
  const Frame done = frames_.back();
  frames_.pop_back();
  Frame& outer = frames_.back();
  const Owner best = std::min(done.owner, done.kept);
  if (outer.is_full && !ranks_.overrides(best, outer.owner)) {
    result.resize(done.output_begin);
    if (best < outer.owner) outer.owner = best.or_worse();
    return;
  }
  ++outer.operands;
  outer.kept = std::min(outer.kept, best);
  const auto symbol = result.begin() + static_cast<std::ptrdiff_t>(done.output_begin);
  if (done.operands == 1) {
    // The one operand can do without the operation if it can take what that knows.
    Symbol& operand = symbol[1];
    const bool keeps_owner = operand.kind == Symbol::Kind::all_of || operand.is_full;
    if ((!done.is_full || operand.is_full) && (done.owner.is_nobody() || keeps_owner)) {
      if (keeps_owner) operand.owner = std::min(operand.owner, done.owner);
      result.erase(symbol);
      return;
    }
  }
  symbol->is_full = done.is_full;
  symbol->owner = done.owner;
  symbol->size = static_cast<std::uint32_t>(result.size() - done.output_begin);
}

}  // namespace tenon::cells
