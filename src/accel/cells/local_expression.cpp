#include "accel/cells/local_expression.h"

#include <algorithm>

#include "csg/expression.h"

namespace tenon::cells {

LocalExpression whole_expression(const CsgTree& tree) {
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
    result.push_back(leaf);
  }
  return result;
}

// Takes a constant operand into the innermost operation.
// @return whether that decides the operation's value
bool Folder::take_constant(bool value, Owner owner) {
  Frame& frame = frames_.back();
  if (frame.kind == Symbol::Kind::all_of) {
    if (value) frame.owner = Owner::first(frame.owner, owner);
    return !value;
  }
  if (!value) return false;
  // Operands that vary may own points, and come first in tree order.
  frame.owner = frame.operands > 0 ? Owner{Owner::varies} : owner;
  return true;
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
    if (!take_constant(constant.value, constant.value ? constant.owner : Owner{})) return false;
    constant = {true, frames_.back().kind == Symbol::Kind::any_of, frames_.back().owner};
  }
}

// The innermost operation varies, and all its operands have been seen.
void Folder::finish_operation(LocalExpression& result) {
  const Frame done = frames_.back();
  frames_.pop_back();
  ++frames_.back().operands;
  const auto symbol = result.begin() + static_cast<std::ptrdiff_t>(done.output_begin);
  const bool has_owner = done.kind == Symbol::Kind::all_of && done.owner != Owner{};
  if (done.operands == 1 && (!has_owner || symbol[1].kind == Symbol::Kind::all_of)) {
    if (has_owner) symbol[1].owner = Owner::first(symbol[1].owner, done.owner);
    result.erase(symbol);
    return;
  }
  symbol->owner = has_owner ? done.owner : Owner{};
  symbol->size = static_cast<std::uint32_t>(result.size() - done.output_begin);
}

}  // namespace tenon::cells
