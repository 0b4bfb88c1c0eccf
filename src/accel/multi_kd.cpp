#include <algorithm>

#include "accel/all.h"
#include "accel/kd_forest.h"
#include "accel/kd_options.h"
#include "accel/structure.h"
#include "kdtree/kd_walk.h"

namespace tenon {

namespace {

/// Multiple kd-trees (Zajíček 2012, §2.3), which the thesis describes and did not build. A ray traverses the enclosing
/// tree from near to far and settles at each cell's exit. An intersection or difference met in a cell responds "by its
/// own traversal": its operands' trees are traversed along the whole ray, one after the other, and everything they
/// hold there is revealed. As soon as an operand without which the operation is empty gives nothing, the rest is left
/// out. Exact for the reason given in okd.cpp.
///
/// Left open by the thesis: the cost of an operation to the tree above it (the sum of its primitives' costs), and how
/// an operation met in several cells is known (a mailbox; mailbox=off switches off those of the primitives alone, since
/// nested operations without it would be traversed exponentially often).
///
/// cells_visited counts kd-nodes of all trees.
class MultiKd {
 public:
  struct Scratch {
    // An operation whose operands are being traversed.
    struct Frame {
      std::uint32_t operation;
      std::uint32_t next_operand;
      std::size_t first_item;  // into items: what the present operand gave
      std::size_t next_item;
      bool found;  // the present operand gave something
    };
    KdStack outer, inner;
    std::vector<Frame> frames;
    std::vector<std::uint32_t> items;
    std::vector<std::uint32_t> visited;  // by node of the operation tree: the stamp of the ray
    std::uint32_t stamp = 0;
  };

  MultiKd(OperationTree operations, KdForest forest, bool mailbox)
      : operations_(std::move(operations)), forest_(std::move(forest)), mailbox_(mailbox) {
    for (const KdTree& tree : forest_.trees()) {
      boxes_ += tree.nodes.size();
      depth_ = std::max(depth_, tree.depth);
    }
  }

  void traverse(Walk& walk, Scratch& scratch) const {
    walk.use_mailbox(mailbox_);
    start(scratch);
    const KdTree& tree = forest_.enclosing_tree();
    TraversalCounters& counters = walk.counters();
    counters.cells_visited += walk_kd_tree(tree, walk.ray(), scratch.outer, [&](const KdNode& leaf, double t_out) {
      for (const std::uint32_t item : tree.items_of(leaf)) {
        if (operations_.nodes()[item].is_leaf()) {
          walk.reveal(operations_.leaf_of(operations_.nodes()[item]));
        } else if (!enter(item, scratch)) {
          ++counters.mailbox_hits;
        } else {
          reveal_operations(walk, scratch);
        }
      }
      return walk.settle(t_out);
    });
  }

  std::size_t memory_bytes() const { return operations_.memory_bytes() + forest_.memory_bytes(); }
  std::size_t boxes() const { return boxes_; }
  int depth() const { return depth_; }

 private:
  void start(Scratch& scratch) const {
    if (scratch.visited.size() < operations_.nodes().size()) scratch.visited.resize(operations_.nodes().size());
    if (++scratch.stamp == 0) {
      std::fill(scratch.visited.begin(), scratch.visited.end(), 0);
      scratch.stamp = 1;
    }
  }

  // Puts an operation on the stack, once per ray.
  bool enter(std::uint32_t operation, Scratch& scratch) const {
    if (scratch.visited[operation] == scratch.stamp) return false;
    scratch.visited[operation] = scratch.stamp;
    const std::size_t first = scratch.items.size();
    scratch.frames.push_back({operation, 0, first, first, true});
    return true;
  }

  // Works off the stack of operations; each may put others on it.
  void reveal_operations(Walk& walk, Scratch& scratch) const {
    while (!scratch.frames.empty()) {
      Scratch::Frame& frame = scratch.frames.back();
      if (frame.next_item < scratch.items.size()) {
        const std::uint32_t item = scratch.items[frame.next_item++];
        if (operations_.nodes()[item].is_leaf()) {
          frame.found = true;
          walk.reveal(operations_.leaf_of(operations_.nodes()[item]));
        } else if (!enter(item, scratch)) {
          ++walk.counters().mailbox_hits;
        }
        continue;
      }
      const KdForest::Operation operation = forest_.operations()[frame.operation];
      if (is_empty(operation, frame)) {
        leave(false, scratch);
      } else if (frame.next_operand == operation.operand_count) {
        leave(true, scratch);
      } else {
        const KdForest::Operand& operand = forest_.operands()[operation.first_operand + frame.next_operand++];
        traverse_operand(forest_.trees()[operand.tree], walk, scratch);
      }
    }
  }

  // The operand just finished was needed, and gave nothing.
  bool is_empty(const KdForest::Operation& operation, const Scratch::Frame& frame) const {
    if (frame.next_operand == 0 || frame.found) return false;
    return forest_.operands()[operation.first_operand + frame.next_operand - 1].needed;
  }

  static void leave(bool found, Scratch& scratch) {
    scratch.items.resize(scratch.frames.back().first_item);
    scratch.frames.pop_back();
    if (!scratch.frames.empty()) scratch.frames.back().found |= found;
  }

  static void traverse_operand(const KdTree& tree, Walk& walk, Scratch& scratch) {
    Scratch::Frame& frame = scratch.frames.back();
    scratch.items.resize(frame.first_item);
    frame.next_item = frame.first_item;
    frame.found = false;
    walk.counters().cells_visited += walk_kd_tree(tree, walk.ray(), scratch.inner, [&](const KdNode& leaf, double) {
      const auto items = tree.items_of(leaf);
      scratch.items.insert(scratch.items.end(), items.begin(), items.end());
      return false;
    });
  }

  OperationTree operations_;
  KdForest forest_;
  bool mailbox_;
  std::size_t boxes_ = 0;
  int depth_ = 0;
};

}  // namespace

Result<std::unique_ptr<Accelerator>> build_multi_kd(const BuildInput& input, AcceleratorOptions& options) {
  const KdOptions kd = take_kd_options(options);
  const bool mailbox = options.take_switch("mailbox", true);
  if (Status status = options.finish(); !status) return status.error();
  OperationTree operations(input.tree);
  KdForest forest(input.tree, operations, kd);
  return std::unique_ptr<Accelerator>(std::make_unique<StructureAccelerator<MultiKd>>(
      input.tree, MultiKd(std::move(operations), std::move(forest), mailbox)));
}

}  // namespace tenon
