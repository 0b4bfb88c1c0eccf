#pragma once

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "csg/classifier.h"
#include "csg/csg_tree.h"
#include "csg/expression.h"

/// Trees and crossings made up without geometry, so that the rules of the classifier are tested alone.
namespace tenon::made_up {

/// Builds a CsgTree from nested calls. Leaves are numbered in the order of leaf().
class TreeBuilder {
 public:
  CsgNodeId leaf() {
    tree_.leaves.emplace_back();
    CsgNode node;
    node.operation = CsgOperation::leaf;
    node.leaf = LeafId{tree_.leaves.size() - 1};
    return add(node, {});
  }
  CsgNodeId operation(CsgOperation op, const std::vector<CsgNodeId>& operands) {
    CsgNode node;
    node.operation = op;
    return add(node, operands);
  }
  CsgNodeId unite(const std::vector<CsgNodeId>& o) { return operation(CsgOperation::union_, o); }
  CsgNodeId intersect(const std::vector<CsgNodeId>& o) { return operation(CsgOperation::intersection, o); }
  CsgNodeId subtract(const std::vector<CsgNodeId>& o) { return operation(CsgOperation::difference, o); }
  CsgNodeId complement(CsgNodeId o) { return operation(CsgOperation::complement, {o}); }

  CsgTree finish(CsgNodeId root) {
    tree_.root = root;
    return std::move(tree_);
  }

 private:
  CsgNodeId add(CsgNode node, const std::vector<CsgNodeId>& operands) {
    const CsgNodeId id{tree_.nodes.size()};
    node.first_child = static_cast<std::uint32_t>(tree_.children.size());
    node.child_count = static_cast<std::uint32_t>(operands.size());
    for (const CsgNodeId o : operands) {
      tree_.children.push_back(o);
      tree_.nodes[o.get()].parent = id;
    }
    tree_.nodes.push_back(node);
    return id;
  }

  CsgTree tree_;
};

/// A random tree over `leaf_count` leaves, each used once, in random shape.
inline CsgNodeId random_subtree(TreeBuilder& build, std::mt19937_64& rng, int leaf_count) {
  const auto pick = [&](int n) { return static_cast<int>(rng() % static_cast<unsigned>(n)); };
  if (leaf_count == 1) {
    const CsgNodeId leaf = build.leaf();
    return pick(6) == 0 ? build.complement(leaf) : leaf;
  }
  const int arity = std::min(leaf_count, 2 + pick(3));
  std::vector<int> share(static_cast<std::size_t>(arity), 1);
  for (int i = 0; i < leaf_count - arity; ++i) ++share[static_cast<std::size_t>(pick(arity))];
  std::vector<CsgNodeId> operands;
  for (const int s : share) operands.push_back(random_subtree(build, rng, s));
  constexpr CsgOperation ops[] = {CsgOperation::union_, CsgOperation::intersection, CsgOperation::difference};
  const CsgNodeId node = build.operation(ops[pick(3)], operands);
  return pick(8) == 0 ? build.complement(node) : node;
}

/// Point membership by the definition of the operations; shares nothing with Expression.
inline bool holds(const CsgTree& tree, CsgNodeId id, const std::vector<bool>& inside) {
  const CsgNode& node = tree[id];
  const auto children = tree.children_of(node);
  switch (node.operation) {
    case CsgOperation::leaf:
      return inside[node.leaf.get()];
    case CsgOperation::complement:
      return !holds(tree, children[0], inside);
    case CsgOperation::union_:
      for (const CsgNodeId c : children) {
        if (holds(tree, c, inside)) return true;
      }
      return false;
    case CsgOperation::intersection:
      for (const CsgNodeId c : children) {
        if (!holds(tree, c, inside)) return false;
      }
      return true;
    case CsgOperation::difference:
      for (std::size_t i = 1; i < children.size(); ++i) {
        if (holds(tree, children[i], inside)) return false;
      }
      return holds(tree, children[0], inside);
  }
  return false;
}

/// Crossings by leaf, and media by leaf when there are any.
struct Source {
  std::vector<Spans> by_leaf;
  std::vector<MediumId> media;     // empty: opaque
  std::vector<double> priorities;  // empty: all 0

  void crossings(LeafId leaf, Spans& out) const {
    out.insert(out.end(), by_leaf[leaf.get()].begin(), by_leaf[leaf.get()].end());
  }
  bool has_media() const { return !media.empty(); }
  MediumId medium(LeafId leaf) const { return media[leaf.get()]; }
  double priority(LeafId leaf) const { return priorities.empty() ? 0 : priorities[leaf.get()]; }
};

/// One stretch inside a leaf: from a to b, each with its error bound.
inline Spans span(double a, double b, double bound_a = 0, double bound_b = 0) {
  return {{a, bound_a, 0, true, false}, {b, bound_b, 1, false, false}};
}

/// A surface met at t.
inline Spans probe(double t, double bound = 0) {
  return {{t, bound, 0, false, true}};
}

/// Follows the ray with every leaf revealed; all runs.
inline std::vector<Run> runs_of(const CsgTree& tree, const Source& source) {
  const Expression expression = Expression::compile(tree);
  Classifier<ExpressionState, Source> classifier(ExpressionState(expression), source, tree.leaves.size());
  classifier.start();
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) classifier.reveal(LeafId{i});
  std::vector<Run> runs;
  while (auto run = classifier.settle(std::numeric_limits<double>::infinity())) runs.push_back(*run);
  EXPECT_EQ(classifier.seam_faults(), 0u);
  return runs;
}

inline std::vector<double> times_of(const std::vector<Run>& runs) {
  std::vector<double> t;
  for (const Run& r : runs) t.push_back(r.t);
  return t;
}

}  // namespace tenon::made_up
