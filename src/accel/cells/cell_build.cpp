#include "accel/cells/cell_build.h"

#include <array>
#include <cmath>
#include <memory>

#include "accel/cells/cell.h"
#include "accel/cells/leaf_regions.h"
#include "primitive/dispatch.h"
#include "tenon/base/parallel_for.h"

namespace tenon::cells {

namespace {

// Relative to one intersection with a sphere: a step down the tree, and a visit to a cell.
constexpr double split_cost = 0.3;
constexpr double cell_cost = 0.5;
constexpr int deepest = 60;
// A cell without a table is followed by the classifier, leaf by leaf.
constexpr double untabled_factor = 8;
// Where many surfaces run through one point no plane helps; so many splits are tried.
constexpr int most_in_vain = 8;
// And as long as they do not multiply the leaves beyond this.
constexpr std::size_t most_copies = std::size_t{1} << 14;

// A part of space under work.
struct Work {
  Box3 box;
  LocalExpression expression;
  std::vector<LeafId> leaves;  // that straddle it, in the order of the expression
  int depth = 0;
  int in_vain = 0;  // splits in a row that left nearly all leaves in this part
};

struct Plane {
  int axis = -1;
  double position = 0;
};

void list_leaves(Work& work) {
  work.leaves.clear();
  for (const Symbol& s : work.expression) {
    if (s.kind == Symbol::Kind::leaf) work.leaves.push_back(s.leaf);
  }
}

std::pair<Box3, Box3> halves(const Box3& box, const Plane& plane) {
  std::pair<Box3, Box3> result{box, box};
  result.first.upper[plane.axis] = plane.position;
  result.second.lower[plane.axis] = plane.position;
  return result;
}

std::uint32_t join(Subdivision& tree, std::uint32_t left, std::uint32_t right) {
  if (left == SubdivisionNode::none) return right;
  if (right == SubdivisionNode::none) return left;
  SubdivisionNode node;
  node.box = hull(tree.nodes[left].box, tree.nodes[right].box);
  node.left = left;
  node.right = right;
  tree.nodes.push_back(node);
  return static_cast<std::uint32_t>(tree.nodes.size() - 1);
}

// Builds one part of the tree. Its memory is reused from cell to cell.
class Subdivider {
 public:
  Subdivider(const CsgTree& tree, const CellScale& scale, const LeafRegions& leaf_regions, const BuildQuality& quality)
      : tree_(tree),
        scale_(scale),
        leaf_regions_(leaf_regions),
        quality_(quality),
        regions_(tree.leaves.size(), Region::outside) {}

  /// Subdivides one part of space by itself.
  /// @param most_symbols  when there are more, nothing is split any further
  Subdivision subdivide(Work& work, std::size_t most_symbols) {
    result_ = {};
    most_symbols_ = most_symbols;
    result_.root = build(work).first;
    return std::move(result_);
  }

  /// Cuts a part in two where it pays.
  /// @return whether there is a plane worth trying; `parts` then tell by their leaves which side has a boundary
  bool split(const Work& work, std::array<Work, 2>& parts) {
    if (!worth_splitting(work)) return false;
    const Plane plane = choose_plane(work);
    if (plane.axis < 0) return false;
    const auto [low, high] = halves(work.box, plane);
    const bool both = restrict_to(low, work, parts[0]) & restrict_to(high, work, parts[1]);
    const bool in_vain = both && keeps_nearly_all(parts[0], work) && keeps_nearly_all(parts[1], work);
    for (Work& part : parts) part.in_vain = in_vain ? work.in_vain + 1 : 0;
    return true;
  }

  /// What is left of the expression in a part of the box. @return whether there is a boundary
  bool restrict_to(const Box3& box, const Work& whole, Work& part) {
    classify_leaves(box, whole.leaves);
    part.box = box;
    part.depth = whole.depth + 1;
    part.leaves.clear();
    if (folder_.fold(whole.expression, regions_, part.expression).constant) return false;
    list_leaves(part);
    return true;
  }

  /// @return the root of what was built, and its expected cost for a ray that meets its box
  std::pair<std::uint32_t, double> build(Work& work) {
    result_.depth = std::max(result_.depth, work.depth);
    const double whole_cost = leaf_cost(work.leaves);
    std::array<Work, 2> parts;
    if (!split(work, parts)) return {add_cell(work), whole_cost};

    const std::size_t nodes = result_.nodes.size(), cells = result_.cells.size(), symbols = result_.symbols.size();
    const double area = work.box.surface_area();
    double cost = split_cost;
    std::uint32_t children[2] = {SubdivisionNode::none, SubdivisionNode::none};
    for (std::size_t side = 0; side < 2; ++side) {
      if (parts[side].leaves.empty()) continue;
      const auto [child, child_cost] = build(parts[side]);
      parts[side] = {};
      // Nothing is left where only the classification of the larger box was in doubt.
      if (child == SubdivisionNode::none) continue;
      children[side] = child;
      cost += child_cost * result_.nodes[child].box.surface_area() / area;
    }
    if (cost >= whole_cost && work.leaves.size() <= Cell::most_followed) {
      result_.nodes.resize(nodes);
      result_.cells.resize(cells);
      result_.symbols.resize(symbols);
      return {add_cell(work), whole_cost};
    }
    return {join(result_, children[0], children[1]), cost};
  }

  Plane choose_plane(const Work& work) {
    Plane best;
    double least = std::numeric_limits<double>::infinity();
    const std::size_t count = work.leaves.size();
    if (count > most_planes_by_leaves) choose_by_bounds(work, best);
    if (count > most_folded) return best;
    if (best.axis >= 0) least = price(work, best);
    const double longest = max_component(work.box.size());
    for (int axis = 0; axis < 3; ++axis) {
      if (work.box.size()[axis] < longest / 8) continue;
      list_candidates(work, axis, positions_);
      for (const double position : positions_) {
        const double p = price(work, {axis, position});
        if (p >= least) continue;
        least = p;
        best = {axis, position};
      }
    }
    return best;
  }

 private:
  // Up to so many leaves a plane is priced by folding the expression on both sides; above, by the leaves' bounds.
  static constexpr std::size_t most_folded = 256;
  // And up to so many the planes tried are those at the leaves' bounds, too; above, the best of bins.
  static constexpr std::size_t most_planes_by_leaves = 3;

  static bool keeps_nearly_all(const Work& part, const Work& whole) {
    return 10 * part.leaves.size() > 9 * whole.leaves.size();
  }

  void classify_leaves(const Box3& box, const std::vector<LeafId>& leaves) {
    const Box3 within = grown(box, scale_.growth);
    for (const LeafId id : leaves) regions_[id.get()] = leaf_regions_.classify(id, within);
  }

  double cost_of(LeafId id) const { return cost(tree_.primitives, tree_[id].primitive); }

  static double weigh(double sum, std::size_t leaves) {
    return leaves <= Cell::most_tabled ? sum : sum * untabled_factor;
  }

  double leaf_cost(const std::vector<LeafId>& leaves) const {
    double sum = cell_cost;
    for (const LeafId id : leaves) sum += cost_of(id);
    return weigh(sum, leaves.size());
  }

  bool worth_splitting(const Work& work) const {
    if (work.leaves.size() <= 1 || work.depth >= deepest || work.in_vain >= most_in_vain) return false;
    if (work.in_vain > 0 && work.leaves.size() << work.in_vain > most_copies) return false;
    if (result_.symbols.size() > most_symbols_) return false;
    double smallest = std::numeric_limits<double>::infinity();
    for (const LeafId id : work.leaves) {
      const Box3& b = tree_[id].bounds;
      if (b.is_bounded()) smallest = std::min(smallest, max_component(b.size()));
    }
    // More leaves than a word of truth values has room for cost much more.
    const double finest = work.leaves.size() <= Cell::most_tabled ? quality_.finest : quality_.finest / 16;
    const double edge = max_component(work.box.size());
    return edge > finest * smallest && edge > 8 * scale_.growth;
  }

  // Evenly spaced planes and the bounds of leaves, a little off, so that faces do not lie in planes.
  void list_candidates(const Work& work, int axis, std::vector<double>& positions) const {
    positions.clear();
    const double low = work.box.lower[axis], high = work.box.upper[axis];
    for (int i = 1; i <= quality_.candidates; ++i) {
      const double f = i / (quality_.candidates + 1.0);
      positions.push_back(low + f * (high - low));
    }
    const double off = 4 * scale_.growth;
    if (work.leaves.size() > most_planes_by_leaves) return;
    for (const LeafId id : work.leaves) {
      const Box3& b = tree_[id].bounds;
      for (const double p : {b.lower[axis] - off, b.upper[axis] + off}) {
        if (p > low + off && p < high - off) positions.push_back(p);
      }
    }
  }

  double folded_cost(const Box3& box, const Work& work) {
    classify_leaves(box, work.leaves);
    if (folder_.fold(work.expression, regions_, trial_).constant) return 0;
    double sum = cell_cost;
    std::size_t count = 0;
    for (const Symbol& s : trial_) {
      if (s.kind != Symbol::Kind::leaf) continue;
      sum += cost_of(s.leaf);
      ++count;
    }
    return weigh(sum, count);
  }

  double price(const Work& work, const Plane& plane) {
    const auto [low, high] = halves(work.box, plane);
    return low.surface_area() * folded_cost(low, work) + high.surface_area() * folded_cost(high, work);
  }

  void choose_by_bounds(const Work& work, Plane& best) const {
    constexpr std::size_t bins = 16;
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double low = work.box.lower[axis], size = work.box.size()[axis];
      if (!(size > 8 * scale_.growth)) continue;
      std::array<double, bins> begins{}, ends{};
      const auto bin_of = [&](double p) {
        const double place = (p - low) / size * static_cast<double>(bins);
        return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bins) - 1));
      };
      for (const LeafId id : work.leaves) {
        const Box3& b = tree_[id].bounds;
        begins[bin_of(b.lower[axis])] += cost_of(id);
        ends[bin_of(b.upper[axis])] += cost_of(id);
      }
      std::array<double, bins> above{};
      double sum = 0;
      for (std::size_t i = bins; i-- > 0;) above[i] = sum += ends[i];
      double below = 0;
      for (std::size_t i = 1; i < bins; ++i) {
        below += begins[i - 1];
        const Plane plane{axis, low + size * static_cast<double>(i) / static_cast<double>(bins)};
        const auto [first, second] = halves(work.box, plane);
        const double price = first.surface_area() * below + second.surface_area() * above[i];
        if (price < least) {
          least = price;
          best = plane;
        }
      }
    }
  }

  std::uint32_t add_cell(const Work& work) {
    BoundaryCell cell;
    cell.box = work.box;
    cell.first_symbol = static_cast<std::uint32_t>(result_.symbols.size());
    cell.symbol_count = static_cast<std::uint32_t>(work.expression.size());
    cell.leaf_count = static_cast<std::uint32_t>(work.leaves.size());
    result_.symbols.insert(result_.symbols.end(), work.expression.begin(), work.expression.end());
    SubdivisionNode node;
    node.box = tight_box(work);
    result_.cells.push_back(cell);
    result_.cells.back().box = node.box;
    node.cell = static_cast<std::uint32_t>(result_.cells.size() - 1);
    result_.nodes.push_back(node);
    return static_cast<std::uint32_t>(result_.nodes.size() - 1);
  }

  // The boundary lies on the leaves, so within their bounds.
  Box3 tight_box(const Work& work) const {
    Box3 leaves;
    for (const LeafId id : work.leaves) leaves = hull(leaves, tree_[id].bounds);
    return intersection(work.box, grown(leaves, scale_.growth));
  }

  const CsgTree& tree_;
  const CellScale& scale_;
  const LeafRegions& leaf_regions_;
  const BuildQuality& quality_;
  Subdivision result_;
  std::vector<Region> regions_;
  std::size_t most_symbols_ = ~std::size_t{0};
  Folder folder_;
  LocalExpression trial_;
  std::vector<double> positions_;
};

// The top of the tree, where every split is kept; parts with few enough leaves are tasks.
class Top {
 public:
  explicit Top(Subdivider& subdivider) : subdivider_(subdivider) {}

  static constexpr std::uint32_t task_bit = 0x80000000, nothing = ~std::uint32_t{0};

  /// @return a node, or a task with its bit
  std::uint32_t grow(Work&& work) {
    std::array<Work, 2> parts;
    if (work.leaves.size() <= Cell::most_followed || !subdivider_.split(work, parts)) {
      tasks_.push_back(std::move(work));
      return static_cast<std::uint32_t>(tasks_.size() - 1) | task_bit;
    }
    work = {};
    std::uint32_t children[2] = {nothing, nothing};
    for (std::size_t side = 0; side < 2; ++side) {
      if (!parts[side].leaves.empty()) children[side] = grow(std::move(parts[side]));
    }
    nodes_.push_back({children[0], children[1]});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  std::vector<Work>& tasks() { return tasks_; }

  /// Joins what the tasks have built, given the roots that they have in `tree`.
  std::uint32_t assemble(std::uint32_t root, const std::vector<std::uint32_t>& task_roots, Subdivision& tree) const {
    if (root == nothing) return SubdivisionNode::none;
    if ((root & task_bit) != 0) return task_roots[root & ~task_bit];
    // Children come before their parents.
    std::vector<std::uint32_t> made;
    const auto find = [&](std::uint32_t child) {
      if (child == nothing) return SubdivisionNode::none;
      return (child & task_bit) != 0 ? task_roots[child & ~task_bit] : made[child];
    };
    for (const auto& [left, right] : nodes_) made.push_back(join(tree, find(left), find(right)));
    return made[root];
  }

 private:
  Subdivider& subdivider_;
  std::vector<Work> tasks_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> nodes_;
};

// Adds one part's nodes, cells and symbols behind those of the others.
// @return the part's root there
std::uint32_t append(const Subdivision& part, Subdivision& whole) {
  constexpr std::uint32_t none = SubdivisionNode::none;
  const auto nodes = static_cast<std::uint32_t>(whole.nodes.size()),
             cells = static_cast<std::uint32_t>(whole.cells.size()),
             symbols = static_cast<std::uint32_t>(whole.symbols.size());
  const auto moved = [](std::uint32_t index, std::uint32_t by) { return index == none ? none : index + by; };
  for (SubdivisionNode node : part.nodes) {
    node.cell = moved(node.cell, cells);
    node.left = moved(node.left, nodes);
    node.right = moved(node.right, nodes);
    whole.nodes.push_back(node);
  }
  for (BoundaryCell cell : part.cells) {
    cell.first_symbol += symbols;
    whole.cells.push_back(cell);
  }
  whole.symbols.insert(whole.symbols.end(), part.symbols.begin(), part.symbols.end());
  whole.depth = std::max(whole.depth, part.depth);
  return moved(part.root, nodes);
}

}  // namespace

Subdivision subdivide(const CsgTree& tree, const CellScale& scale, const Box3& box, const BuildQuality& quality,
                      int threads) {
  const LeafRegions leaf_regions(tree);
  Subdivision result;
  Work whole, root;
  whole.expression = whole_expression(tree);
  whole.depth = -1;
  list_leaves(whole);
  Subdivider subdivider(tree, scale, leaf_regions, quality);
  if (!subdivider.restrict_to(box, whole, root)) return result;
  whole = {};
  Top top(subdivider);
  const std::uint32_t top_root = top.grow(std::move(root));

  // Memory stays in proportion to the scene, shared out by the leaves of each part.
  std::size_t leaves = 0;
  for (const Work& task : top.tasks()) leaves += task.leaves.size();
  const double symbols_per_leaf =
      (0x1p20 + 48.0 * static_cast<double>(tree.leaves.size())) / static_cast<double>(std::max<std::size_t>(leaves, 1));

  std::vector<std::unique_ptr<Subdivider>> workers(static_cast<std::size_t>(std::max(threads, 1)));
  std::vector<Subdivision> parts(top.tasks().size());
  parallel_for(parts.size(), threads, [&](std::size_t task, int worker) {
    auto& own = workers[static_cast<std::size_t>(worker)];
    if (!own) own = std::make_unique<Subdivider>(tree, scale, leaf_regions, quality);
    Work& work = top.tasks()[task];
    const double most = symbols_per_leaf * static_cast<double>(work.leaves.size());
    parts[task] = own->subdivide(work, static_cast<std::size_t>(most));
    work = {};
  });
  std::vector<std::uint32_t> roots;
  for (Subdivision& part : parts) {
    roots.push_back(append(part, result));
    part = {};
  }
  result.root = top.assemble(top_root, roots, result);
  return result;
}

}  // namespace tenon::cells
