#include "accel/cells/cell_build.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "accel/cells/subdivider.h"
#include "tenon/base/parallel_for.h"

namespace tenon::cells {

namespace {

// A subdivider for each thread.
class Workers {
 public:
  Workers(const SubdivisionInput& input, int threads)
      : input_(input), subdividers_(static_cast<std::size_t>(std::max(threads, 1))) {}

  Subdivider& operator[](int worker) {
    auto& own = subdividers_[static_cast<std::size_t>(worker)];
    if (!own) own = std::make_unique<Subdivider>(input_);
    return *own;
  }
  int threads() const { return static_cast<int>(subdividers_.size()); }

 private:
  const SubdivisionInput& input_;
  std::vector<std::unique_ptr<Subdivider>> subdividers_;
};

// The top of the tree, where every split is kept.
class Top {
 public:
  struct Node {
    SpacePart part;  // of one that is not split
    std::uint32_t left = SubdivisionNode::none, right = SubdivisionNode::none;
    bool is_split = false;
  };

  // Splits parts with more leaves than `most_leaves`, all that there are in each round at the same time.
  void grow(SpacePart&& root, std::size_t most_leaves, Workers& workers) {
    std::vector<std::uint32_t> round = {add(std::move(root))};
    const auto done = [&](std::uint32_t node) { return nodes_[node].part.leaves.size() <= most_leaves; };
    while (std::erase_if(round, done), !round.empty()) {
      std::vector<std::array<SpacePart, 2>> sides(round.size());
      std::vector<char> split(round.size());
      parallel_for(round.size(), workers.threads(), [&](std::size_t i, int worker) {
        Node& node = nodes_[round[i]];
        split[i] = workers[worker].split(node.part, sides[i]);
        if (split[i]) node.part = {};
      });
      std::vector<std::uint32_t> next;
      for (std::size_t i = 0; i < round.size(); ++i) {
        if (!split[i]) continue;
        nodes_[round[i]].is_split = true;
        if (sides[i][0].has_boundary()) next.push_back(nodes_[round[i]].left = add(std::move(sides[i][0])));
        if (sides[i][1].has_boundary()) next.push_back(nodes_[round[i]].right = add(std::move(sides[i][1])));
      }
      round = std::move(next);
    }
  }

  /// Children come after their parents.
  std::vector<Node>& nodes() { return nodes_; }

 private:
  std::uint32_t add(SpacePart&& part) {
    nodes_.push_back({std::move(part), SubdivisionNode::none, SubdivisionNode::none, false});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  std::vector<Node> nodes_;
};

// What a part of the top came to.
struct BuiltPart {
  std::size_t leaves = 0;
  Subdivision subdivision;
  Subdivision::Built root;
  HugePageVector<WideNode> nodes;  // where it was collapsed by itself
};

// Makes room for the whole, judged by the part that is there, so that what is added does not move it late: for a moment
// that takes twice the memory.
template <class List>
void reserve_whole(List& list, double part) {
  constexpr double spare = 1.125, most_at_once = 8;
  if (part >= 1 || spare * static_cast<double>(list.size()) < static_cast<double>(list.capacity())) return;
  list.reserve(static_cast<std::size_t>(std::min(spare / part, most_at_once) * static_cast<double>(list.size())));
}

class Assembly {
 public:
  Assembly(const SubdivisionInput& input, const Vec3& center) : input_(input), center_(center) {
    cells_.nodes.emplace_back();
  }

  // Large parts are collapsed by themselves, or their binary nodes would take more memory than all the rest.
  void collapse_if_large(BuiltPart& part) const {
    constexpr std::size_t most_nodes = 2048;
    std::vector<SubdivisionNode>& binary = part.subdivision.nodes;
    if (binary.size() <= most_nodes) return;
    part.nodes.emplace_back();
    collapse(binary, part.root.node, center_, input_.scale.slack, 0, part.nodes);
    const Box3 box = binary[part.root.node].box;
    binary.clear();
    part.root.node = part.subdivision.add_leaf(box, ChildRef::node(0));
  }

  /// @param done  which part of the whole this one and those before it are, about
  /// @return the part's root among the binary nodes of the whole
  std::uint32_t append(const BuiltPart& part, double done) {
    cells_.depth = std::max(cells_.depth, part.subdivision.depth);
    if (part.root.node == SubdivisionNode::none) return part.root.node;
    const auto first = static_cast<std::uint32_t>(whole_.nodes.size());
    const std::size_t first_node = cells_.nodes.size(), first_cell = cells_.store.cells.size();
    const auto moved = [&](ChildRef ref) {
      if (ref.is_none()) return ref;
      return ref.is_cell() ? ChildRef::cell(ref.index() + first_cell) : ChildRef::node(ref.index() + first_node);
    };
    for (SubdivisionNode node : part.subdivision.nodes) {
      if (node.is_split()) {
        node.left += first;
        node.right += first;
      } else {
        node.leaf = moved(node.leaf);
      }
      whole_.nodes.push_back(node);
    }
    for (WideNode node : part.nodes) {
      for (ChildRef& child : node.children) child = moved(child);
      cells_.nodes.push_back(node);
    }
    cells_.store.append(part.subdivision.store);
    reserve_whole(cells_.nodes, done);
    reserve_whole(cells_.store.cells, done);
    return part.root.node + first;
  }

  /// @param top    children come after their parents
  /// @param roots  of the parts that are not split, as append() has returned them
  BuiltCells finish(const std::vector<Top::Node>& top, std::vector<std::uint32_t> roots) {
    const auto root_of = [&](std::uint32_t node) { return node == SubdivisionNode::none ? node : roots[node]; };
    for (std::size_t i = top.size(); i-- > 0;) {
      if (top[i].is_split) roots[i] = whole_.join(root_of(top[i].left), root_of(top[i].right));
    }
    const std::uint32_t root = roots.front();
    if (root == SubdivisionNode::none) return {};
    const ChildRef leaf = whole_.nodes[root].leaf;
    if (whole_.nodes[root].is_split() || leaf.is_cell()) {
      collapse(whole_.nodes, root, center_, input_.scale.slack, 0, cells_.nodes);
    } else {
      cells_.nodes.front() = cells_.nodes[leaf.index()];
    }
    return std::move(cells_);
  }

 private:
  const SubdivisionInput& input_;
  const Vec3 center_;
  Subdivision whole_;  // binary nodes alone
  BuiltCells cells_;
};

}  // namespace

BuiltCells build_cells(const SubdivisionInput& input, const Box3& box, const Vec3& center, int threads) {
  Workers workers(input, threads);
  SpacePart root;
  {
    SpacePart whole;
    whole.expression = whole_expression(input.tree, input.ranks);
    whole.depth = -1;
    workers[0].restrict_to(box, whole, root);
  }
  if (!root.has_boundary()) return {};
  // So few that the parts are many more than threads, whatever the scene.
  const std::size_t most_leaves = std::max(Cell::most_followed, root.leaves.size() / 512);
  Top top;
  top.grow(std::move(root), most_leaves, workers);

  std::vector<Top::Node>& nodes = top.nodes();
  std::vector<std::uint32_t> tasks;
  std::size_t leaves = 0;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].is_split) continue;
    tasks.push_back(i);
    leaves += nodes[i].part.leaves.size();
  }
  // Memory stays in proportion to the scene, shared out by the leaves of each part.
  const double most_cells = input.limits.cells ? static_cast<double>(*input.limits.cells)
                                               : 0x1p19 + 32.0 * static_cast<double>(input.tree.leaves.size());
  const double cells_per_leaf = most_cells / static_cast<double>(leaves);

  Assembly assembly(input, center);
  std::vector<std::uint32_t> roots(nodes.size(), SubdivisionNode::none);
  // A batch is appended, in its order, while the next one is built.
  constexpr std::size_t batch = 64;
  std::vector<BuiltPart> parts, built;
  std::size_t leaves_done = 0, appended = 0;
  const auto append_built = [&] {
    for (BuiltPart& part : built) {
      leaves_done += part.leaves;
      const double done = static_cast<double>(leaves_done) / static_cast<double>(leaves);
      roots[tasks[appended++]] = assembly.append(part, done);
      part = {};
    }
    built.clear();
  };
  for (std::size_t begin = 0; begin < tasks.size(); begin += batch) {
    parts.resize(std::min(batch, tasks.size() - begin));
    const std::size_t before = built.empty() ? 0 : 1;
    parallel_for(before + parts.size(), threads, [&](std::size_t task, int worker) {
      if (task < before) return append_built();
      const std::size_t i = task - before;
      const SpacePart part = std::exchange(nodes[tasks[begin + i]].part, {});
      parts[i].leaves = part.leaves.size();
      const auto most_here = static_cast<std::size_t>(cells_per_leaf * static_cast<double>(part.leaves.size()));
      parts[i].subdivision = workers[worker].subdivide(part, most_here, parts[i].root);
      assembly.collapse_if_large(parts[i]);
    });
    std::swap(parts, built);
  }
  append_built();
  return assembly.finish(nodes, std::move(roots));
}

}  // namespace tenon::cells
