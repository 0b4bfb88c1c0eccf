#include "accel/projection.h"

#include <algorithm>

#include "csg/expression.h"

namespace tenon {

namespace {

using Kind = SubtreeToken::Kind;

// The operands of each node of an expression, as CSR arrays: operands.of(n) are those of node n.
struct Operands {
  struct Operand {
    std::uint32_t id;
    bool is_leaf;
  };
  std::vector<std::uint32_t> first;
  std::vector<Operand> all;

  explicit Operands(const Expression& e) : first(e.nodes.size() + 1) {
    const auto each = [&e](auto&& visit) {
      for (std::uint32_t i = 1; i < e.nodes.size(); ++i) visit(e.nodes[i].parent, Operand{i, false});
      for (std::uint32_t i = 0; i < e.leaves.size(); ++i) {
        if (e.leaves[i].parent != Expression::none) visit(e.leaves[i].parent, Operand{i, true});
      }
    };
    each([this](std::uint32_t parent, Operand) { ++first[parent + 1]; });
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    all.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    each([&](std::uint32_t parent, Operand operand) { all[next[parent]++] = operand; });
  }
  std::uint32_t count(std::uint32_t node) const { return first[node + 1] - first[node]; }
};

SubtreeToken operation_token(const Expression::Node& node, std::uint32_t operands) {
  if (node.threshold == 0) return {Kind::everything, 0};  // an intersection of nothing
  return {node.threshold == operands ? Kind::intersection : Kind::union_, operands};
}

}  // namespace

Subtree subtree_of(const CsgTree& tree) {
  const Expression expression = Expression::compile(tree);
  const Operands operands(expression);
  Subtree out;
  struct Visit {
    std::uint32_t node, next;
  };
  std::vector<Visit> stack{{0, operands.first[0]}};
  while (!stack.empty()) {
    Visit& visit = stack.back();
    if (visit.next == operands.first[visit.node + 1]) {
      const SubtreeToken token = operation_token(expression.nodes[visit.node], operands.count(visit.node));
      // One operand is its own union, none is null.
      if (token.kind == Kind::everything || token.value > 1) out.push_back(token);
      if (token.kind == Kind::union_ && token.value == 0 && stack.size() > 1) out.push_back(token);
      stack.pop_back();
      continue;
    }
    const Operands::Operand operand = operands.all[visit.next++];
    if (!operand.is_leaf) {
      stack.push_back({operand.id, operands.first[operand.id]});
    } else {
      out.push_back({expression.leaves[operand.id].complemented ? Kind::complemented_leaf : Kind::leaf, operand.id});
    }
  }
  return out;
}

Subtree subtree_of(const std::vector<LeafId>& leaves) {
  Subtree out;
  for (const LeafId leaf : leaves) out.push_back({Kind::leaf, leaf.get()});
  if (leaves.size() > 1) out.push_back({Kind::union_, static_cast<std::uint32_t>(leaves.size())});
  return out;
}

Subtree Projection::project(const Subtree& tree, const Box3& box) {
  Subtree out;
  starts_.clear();
  for (const SubtreeToken& token : tree) {
    switch (token.kind) {
      case Kind::leaf:
      case Kind::complemented_leaf:
        starts_.push_back(out.size());
        if (enclosure(token.leaf()).overlaps(box)) {
          out.push_back(token);
        } else if (token.kind == Kind::complemented_leaf) {
          out.push_back({Kind::everything, 0});
        }
        break;
      case Kind::everything:
        starts_.push_back(out.size());
        out.push_back(token);
        break;
      case Kind::union_:
        project_union(out, token.value);
        break;
      case Kind::intersection:
        project_intersection(out, token.value);
        break;
    }
  }
  return out;
}

// The operands of the operation begin at the last `operands` of starts_, each where the one before ends.
void Projection::project_union(Subtree& out, std::size_t operands) {
  const std::size_t base = starts_.size() - operands;
  const std::size_t start = operands == 0 ? out.size() : starts_[base];
  std::uint32_t kept = 0;
  bool everything = false;
  for (std::size_t i = 0; i < operands; ++i) {
    const std::size_t from = starts_[base + i];
    const std::size_t to = i + 1 < operands ? starts_[base + i + 1] : out.size();
    if (from == to) continue;
    ++kept;
    everything |= to - from == 1 && out[from].kind == Kind::everything;
  }
  if (everything && !has_media_) {
    out.resize(start);
    out.push_back({Kind::everything, 0});
  } else if (kept > 1) {
    out.push_back({Kind::union_, kept});
  }
  starts_.resize(base);
  starts_.push_back(start);
}

void Projection::project_intersection(Subtree& out, std::size_t operands) {
  const std::size_t base = starts_.size() - operands;
  const std::size_t start = starts_[base];
  const std::size_t end = out.size();
  std::size_t write = start;
  std::uint32_t kept = 0;
  bool null = false;
  for (std::size_t i = 0; i < operands; ++i) {
    const std::size_t from = starts_[base + i];
    const std::size_t to = i + 1 < operands ? starts_[base + i + 1] : end;
    null |= from == to;
    if (to - from == 1 && out[from].kind == Kind::everything) continue;
    ++kept;
    // Moved only behind a gap: a long chain would else be moved once for each of its operations.
    if (write != from) std::copy(out.data() + from, out.data() + to, out.data() + write);
    write += to - from;
  }
  out.resize(null ? start : write);
  if (!null && kept == 0) out.push_back({Kind::everything, 0});
  if (!null && kept > 1) out.push_back({Kind::intersection, kept});
  starts_.resize(base);
  starts_.push_back(start);
}

std::size_t Projection::count_primitives(const Subtree& tree) const {
  std::size_t count = 0;
  for (const SubtreeToken& token : tree) count += token.is_leaf() && is_bounded(token.leaf());
  return count;
}

Box3 Projection::enclose(const Subtree& tree, const Box3& box) {
  boxes_.clear();
  for (const SubtreeToken& token : tree) {
    switch (token.kind) {
      case Kind::leaf:
        boxes_.push_back(intersection(enclosure(token.leaf()), box));
        break;
      case Kind::complemented_leaf:
      case Kind::everything:
        boxes_.push_back(box);
        break;
      case Kind::union_:
      case Kind::intersection: {
        const std::size_t base = boxes_.size() - token.value;
        Box3 sum = token.value == 0 ? Box3::empty() : boxes_[base];
        for (std::size_t i = base + 1; i < boxes_.size(); ++i) {
          sum = token.kind == Kind::union_ ? hull(sum, boxes_[i]) : intersection(sum, boxes_[i]);
        }
        boxes_.resize(base);
        boxes_.push_back(sum);
        break;
      }
    }
  }
  return boxes_.empty() ? Box3::empty() : boxes_.front();
}

}  // namespace tenon
