#include "accel/bsp_tree.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "accel/macdonald_booth.h"
#include "kdtree/reference_budget.h"

namespace tenon {

namespace {

// A node whose primitives are known and that is still to be split or to become a leaf.
struct Pending {
  std::uint32_t node;
  int depth;
  Box3 cell;
  std::vector<std::uint32_t> items;
  ReferenceBudget budget;
};

class Builder {
 public:
  Builder(const std::vector<EnclosedLeaf>& leaves, const BspOptions& options) : leaves_(leaves), options_(options) {}

  BspTree run(const Box3& box) {
    tree_.box = box;
    std::vector<std::uint32_t> all(leaves_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    tree_.nodes.emplace_back();
    pending_.push_back({0, 0, box, std::move(all), ReferenceBudget::of_root(leaves_.size())});
    while (!pending_.empty()) {
      Pending next = std::move(pending_.back());
      pending_.pop_back();
      tree_.depth = std::max(tree_.depth, next.depth);
      if (!split(next)) make_leaf(next);
    }
    tree_.nodes.shrink_to_fit();
    tree_.cells.shrink_to_fit();
    tree_.items.shrink_to_fit();
    return std::move(tree_);
  }

 private:
  bool split(const Pending& parent) {
    if (parent.items.size() <= static_cast<std::size_t>(options_.leaf) || parent.depth >= options_.depth) return false;
    // Where every box covers the whole cell, no plane ever tells two of them apart.
    if (std::all_of(parent.items.begin(), parent.items.end(),
                    [&](std::uint32_t i) { return leaves_[i].box.contains(parent.cell); })) {
      return false;
    }
    const std::optional<AxisPlane> plane = choose_plane(parent);
    if (!plane) return false;
    const auto [axis, position] = *plane;

    std::vector<std::uint32_t> below, above;
    for (const std::uint32_t i : parent.items) {
      const double lower = leaves_[i].box.lower[axis], upper = leaves_[i].box.upper[axis];
      if (lower < position || upper <= position) below.push_back(i);  // a flat box in the plane lies below it
      if (upper > position) above.push_back(i);
    }
    if (!parent.budget.covers(below.size(), above.size())) return false;
    const auto [budget_below, budget_above] = parent.budget.divide(below.size(), above.size());

    const auto child = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.resize(tree_.nodes.size() + 2);
    tree_.nodes[parent.node] = {position, child, static_cast<std::uint32_t>(axis)};
    Box3 cell_below = parent.cell, cell_above = parent.cell;
    cell_below.upper[axis] = position;
    cell_above.lower[axis] = position;
    pending_.push_back({child + 1, parent.depth + 1, cell_above, std::move(above), budget_above});
    pending_.push_back({child, parent.depth + 1, cell_below, std::move(below), budget_below});
    return true;
  }

  std::optional<AxisPlane> choose_plane(const Pending& parent) {
    if (options_.split == BspSplit::macdonald_booth) return macdonald_booth_.choose(leaves_, parent.items, parent.cell);
    for (int turn = 0; turn < 3; ++turn) {
      const int axis = (parent.depth + turn) % 3;
      const double middle = parent.cell.center()[axis];
      // A cell may be so thin that no number lies between its faces.
      if (parent.cell.lower[axis] < middle && middle < parent.cell.upper[axis]) return AxisPlane{axis, middle};
    }
    return std::nullopt;
  }

  void make_leaf(const Pending& p) {
    tree_.nodes[p.node] = {0, static_cast<std::uint32_t>(tree_.cells.size()), BspNode::leaf_axis};
    tree_.cells.push_back({static_cast<std::uint32_t>(tree_.items.size()), static_cast<std::uint32_t>(p.items.size())});
    for (const std::uint32_t i : p.items) tree_.items.push_back(leaves_[i].leaf);
  }

  const std::vector<EnclosedLeaf>& leaves_;
  const BspOptions& options_;
  BspTree tree_;
  std::vector<Pending> pending_;
  MacDonaldBooth macdonald_booth_;
};

}  // namespace

BspTree build_bsp_tree(const std::vector<EnclosedLeaf>& leaves, const Box3& box, const BspOptions& options) {
  return Builder(leaves, options).run(box);
}

}  // namespace tenon
