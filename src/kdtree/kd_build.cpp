#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "kdtree/kd_events.h"
#include "kdtree/kd_tree.h"
#include "kdtree/reference_budget.h"

namespace tenon {

namespace {

enum class Side : std::uint8_t { both, below, above };

// A node that is still to be split or to become a leaf.
struct Pending {
  std::uint32_t node;
  int depth;
  Box3 cell;
  KdEvents events;
  std::size_t count;
  double cost;  // of all its items
  ReferenceBudget budget;
};

float round_down(double x) {
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float round_up(double x) {
  return -round_down(-x);
}

/// The algorithm of Wald & Havran, "On building fast kd-trees for ray tracing, and on doing that in O(N log N)" (2006):
/// events are sorted once, and each split divides the sorted lists. Since primitives are known by their boxes alone,
/// nothing is clipped: an event outside a cell is no candidate there, and counts as what it is, begun before the cell
/// or ending behind it.
class Builder {
 public:
  Builder(std::span<const KdItem> items, const KdOptions& options) : items_(items), options_(options) {}

  KdTree run() {
    Pending root{0, 0, {}, {}, items_.size(), 0, ReferenceBudget::of_root(items_.size())};
    for (const KdItem& item : items_) {
      floats_.push_back(to_float(item));
      root.cell = hull(root.cell, item.box);
      root.cost += item.cost;
    }
    root.events = sorted_events(floats_);
    sides_.resize(items_.size());
    const int havran =
        8 + static_cast<int>(1.3 * std::log2(static_cast<double>(std::max<std::size_t>(1, items_.size()))));
    deepest_ = std::min(options_.depth < 0 ? havran : options_.depth, KdTree::deepest);

    tree_.box = root.cell;
    tree_.nodes.emplace_back();
    pending_.push_back(std::move(root));
    while (!pending_.empty()) {
      const Pending next = std::move(pending_.back());
      pending_.pop_back();
      tree_.depth = std::max(tree_.depth, next.depth);
      if (!split(next)) make_leaf(next);
    }
    tree_.nodes.shrink_to_fit();
    tree_.items.shrink_to_fit();
    return std::move(tree_);
  }

 private:
  static KdFloatItem to_float(const KdItem& item) {
    const Box3& b = item.box;
    return {{round_down(b.lower.x), round_down(b.lower.y), round_down(b.lower.z)},
            {round_up(b.upper.x), round_up(b.upper.y), round_up(b.upper.z)},
            item.cost};
  }

  bool split(const Pending& parent) {
    if (parent.depth >= deepest_ || parent.count == 0) return false;
    const SurfaceAreaHeuristic heuristic(options_.split, options_.traversal_cost, parent.cell);
    const std::optional<KdPlane> plane =
        find_cheapest_plane(parent.events, floats_, parent.cost, parent.cell, heuristic);
    if (!plane || !(plane->cost < parent.cost)) return false;

    classify(parent, *plane);
    Pending below{0, parent.depth + 1, parent.cell, {}, 0, 0, parent.budget};
    Pending above = below;
    count_sides(parent, below, above);
    if (!parent.budget.covers(below.count, above.count)) return false;
    std::tie(below.budget, above.budget) = parent.budget.divide(below.count, above.count);
    divide_events(parent, below, above);

    const auto child = static_cast<std::uint32_t>(tree_.nodes.size());
    if (child >= KdNode::index_limit - 2) return false;
    below.node = child;
    above.node = child + 1;
    below.cell.upper[plane->axis] = static_cast<double>(plane->position);
    above.cell.lower[plane->axis] = static_cast<double>(plane->position);
    tree_.nodes.resize(tree_.nodes.size() + 2);
    tree_.nodes[parent.node] = KdNode::inner(plane->axis, plane->position, child);
    pending_.push_back(std::move(above));
    pending_.push_back(std::move(below));
    return true;
  }

  // On which sides of the plane each item of the node lies.
  void classify(const Pending& parent, const KdPlane& plane) {
    const std::vector<KdEvent>& list = parent.events[static_cast<std::size_t>(plane.axis)];
    for (const KdEvent& e : list) sides_[e.item] = Side::both;
    for (const KdEvent& e : list) {
      switch (e.kind) {
        case KdEventKind::end:
          if (e.position <= plane.position) sides_[e.item] = Side::below;
          break;
        case KdEventKind::start:
          if (e.position >= plane.position) sides_[e.item] = Side::above;
          break;
        case KdEventKind::flat:
          sides_[e.item] = e.position < plane.position || (e.position == plane.position && plane.flat_below)
                               ? Side::below
                               : Side::above;
          break;
      }
    }
  }

  void count_sides(const Pending& parent, Pending& below, Pending& above) const {
    for (const KdEvent& e : parent.events[0]) {
      if (e.kind == KdEventKind::end) continue;
      for (Pending* side : {&below, &above}) {
        if (sides_[e.item] == (side == &below ? Side::above : Side::below)) continue;
        ++side->count;
        side->cost += floats_[e.item].cost;
      }
    }
  }

  void divide_events(const Pending& parent, Pending& below, Pending& above) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const KdEvent& e : parent.events[axis]) {
        if (sides_[e.item] != Side::above) below.events[axis].push_back(e);
        if (sides_[e.item] != Side::below) above.events[axis].push_back(e);
      }
    }
  }

  void make_leaf(const Pending& p) {
    tree_.nodes[p.node] =
        KdNode::leaf(static_cast<std::uint32_t>(tree_.items.size()), static_cast<std::uint32_t>(p.count));
    for (const KdEvent& e : p.events[0]) {
      if (e.kind != KdEventKind::end) tree_.items.push_back(items_[e.item].item);
    }
  }

  std::span<const KdItem> items_;
  const KdOptions& options_;
  int deepest_ = 0;
  KdTree tree_;
  std::vector<KdFloatItem> floats_;
  std::vector<Side> sides_;
  std::vector<Pending> pending_;
};

}  // namespace

KdTree build_kd_tree(std::span<const KdItem> items, const KdOptions& options) {
  return Builder(items, options).run();
}

}  // namespace tenon
