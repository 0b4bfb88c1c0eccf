// The native bounding volume hierarchy of Zajíček 2012, §2.1: the CSG tree as modelled is the hierarchy; every
// operation is a node with a box around what it groups.
//
// Where the paper leaves something open, or errs:
//   * Clipping (figure 2.1): an intersection clips its operands to their common box, and a difference clips what is
//     subtracted to the box of what it is subtracted from. The paper says that "the left operand can be clipped to the
//     part that intersects with the right", which would lose the rest of the left operand. Clips reach down to the
//     leaves, so clipped boxes are the minimum enclosures. A complement clips nothing, and its node holds what its
//     operand holds: a ray that misses that box meets no boundary there. `clip=off` keeps the whole boxes.
//   * Half-spaces have no box; they are revealed to every ray, and nodes of nothing else are left out.
//   * The paper evaluates the Booleans on the way back up the tree. Here the classifier does, so the traversal only
//     reveals the leaves whose boxes are met: `order=tree`, the paper's, depth first and settled at the end.
//     `order=near`, which the paper has not, opens nodes nearest first and may stop early.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "accel/all.h"
#include "accel/nearest_first.h"
#include "accel/structure.h"
#include "csg/enclosures.h"
#include "kdtree/ray_box.h"

namespace tenon {

namespace {

enum class NbvhOrder : std::size_t { tree, near };

class Nbvh {
 public:
  struct Scratch {
    EntryQueue queue;
  };

  Nbvh(const CsgTree& tree, bool clip, NbvhOrder order) : order_(order) {
    const std::vector<Box3> boxes = node_boxes(tree, clip);
    lay_out(tree, boxes);
  }

  void traverse(Walk& walk, Scratch& scratch) const {
    if (nodes_.empty()) return;
    if (order_ == NbvhOrder::near) {
      traverse_near(walk, scratch.queue);
      return;
    }
    const double t_max = walk.query().t_max;
    reveal_until(walk, t_max);
    if (!(t_max < std::numeric_limits<double>::infinity()) || walk.settle(t_max)) return;
    // A run that began before t_max waits for faces behind it.
    reveal_until(walk, std::numeric_limits<double>::infinity());
  }

  std::size_t memory_bytes() const { return nodes_.size() * sizeof(Node); }
  std::size_t boxes() const { return nodes_.size(); }
  int depth() const { return depth_; }

 private:
  struct Node {
    Box3 box;
    std::uint32_t end;  // the node behind the last one of this subtree; the first child, if any, is the next node
    LeafId leaf;        // none for an operation
  };

  // A box around the clipped leaves below each node of the tree; empty when there are none.
  static std::vector<Box3> node_boxes(const CsgTree& tree, bool clip) {
    std::vector<Box3> boxes(tree.nodes.size());
    for (const EnclosedLeaf& l : enclosed_leaves(tree, clip)) boxes[tree[l.leaf].node.get()] = l.box;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      for (const CsgNodeId child : tree.children_of(tree.nodes[i])) boxes[i] = hull(boxes[i], boxes[child.get()]);
    }
    return boxes;
  }

  // Puts the nodes that hold anything in depth-first order. A place follows from the sizes of the subtrees before it,
  // so no stack is needed, however deep the tree.
  void lay_out(const CsgTree& tree, const std::vector<Box3>& boxes) {
    const std::size_t count = tree.nodes.size();
    std::vector<std::uint32_t> size(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      if (boxes[i].is_empty()) continue;
      size[i] = 1;
      for (const CsgNodeId child : tree.children_of(tree.nodes[i])) size[i] += size[child.get()];
    }
    if (!tree.root || size[tree.root.get()] == 0) return;

    nodes_.resize(size[tree.root.get()]);
    std::vector<std::uint32_t> place(count, 0);
    std::vector<int> level(count, 1);
    for (std::size_t i = count; i-- > 0;) {  // parents first
      if (size[i] == 0) continue;
      nodes_[place[i]] = {boxes[i], place[i] + size[i], tree.nodes[i].leaf};
      depth_ = std::max(depth_, level[i]);
      std::uint32_t next = place[i] + 1;
      for (const CsgNodeId child : tree.children_of(tree.nodes[i])) {
        place[child.get()] = next;
        level[child.get()] = level[i] + 1;
        next += size[child.get()];
      }
    }
  }

  // Depth first. A box that the ray misses skips its subtree.
  void reveal_until(Walk& walk, double t_max) const {
    const BoxRay ray(walk.ray());
    for (std::uint32_t i = 0; i < nodes_.size();) {
      const Node& node = nodes_[i];
      if (clip(ray, node.box, 0, t_max).empty()) {
        i = node.end;
        continue;
      }
      ++walk.counters().cells_visited;
      if (node.leaf) walk.reveal(node.leaf);
      ++i;
    }
  }

  void traverse_near(Walk& walk, EntryQueue& queue) const {
    const BoxRay ray(walk.ray());
    queue.clear();
    const auto push = [&](std::uint32_t i) {
      const BoxSpan span = clip(ray, nodes_[i].box);
      if (!span.empty()) queue.push(span.t_in, i);
    };
    push(0);
    nearest_first(walk, queue, [&](std::uint32_t i) {
      if (nodes_[i].leaf) walk.reveal(nodes_[i].leaf);
      for (std::uint32_t child = i + 1; child < nodes_[i].end; child = nodes_[child].end) push(child);
    });
  }

  std::vector<Node> nodes_;
  NbvhOrder order_;
  int depth_ = 0;
};

}  // namespace

Result<std::unique_ptr<Accelerator>> build_nbvh(const BuildInput& input, AcceleratorOptions& options) {
  const bool clip = options.take_switch("clip", true);
  const auto order = static_cast<NbvhOrder>(options.take_word("order", {"tree", "near"}));
  if (Status status = options.finish(); !status) return status.error();
  return std::unique_ptr<Accelerator>(
      std::make_unique<StructureAccelerator<Nbvh>>(input.tree, Nbvh(input.tree, clip, order)));
}

}  // namespace tenon
