#include "accel/all.h"
#include "accel/kd_options.h"
#include "accel/operation_marks.h"
#include "accel/structure.h"
#include "csg/enclosures.h"
#include "kdtree/kd_walk.h"

namespace tenon {

namespace {

/// The OKD-tree (Zajíček 2012, §2.4 and §2.5): one kd-tree over all primitives of the scene, and an operation tree with
/// marks. A ray is traced in three phases: the kd-tree is traversed from end to end; each leaf of it marks its
/// primitives in the operation tree; then the marked primitives are intersected and combined. Booleans forbid an end at
/// the first hit, says the thesis, so the ray is settled once, at its end.
///
/// Left open by the thesis:
///   C_t is not given: 0.5 tests of a sphere (traversal-cost).
///   SA(Split) of eq. 2.1 is ambiguous: see SurfaceAreaHeuristic.
///   "A predetermined depth limit": Havran's 8 + 1.3 log2 N (depth).
///   Which boxes: those of §2.2, clipped by the operations, which are the minimum enclosures (clip=off: whole boxes).
///   In the pseudo code a mark climbs to the root, and every marked primitive is tested. Its text says that marking
///   leaves out whole branches: here an operation hands the mark on when the operands without which it is empty are
///   marked, so an unmarked minuend spares the tools' tests (skip=off: as in the pseudo code).
///
/// *The answer is exact.* By induction over the tree: a node that did not hand its mark on has, all along the ray, the
/// value it would have were its bounded leaves empty. A leaf without a mark meets the ray nowhere in its minimum
/// enclosure, and outside that its value changes nothing; a difference without its minuend, or an intersection without
/// one of its operands, is empty whatever the rest is.
///
/// cells_visited counts kd-nodes, inner ones and leaves; mailbox_hits counts marks met again (§2.5: "the marking system
/// works as a mail-boxing system").
class Okd {
 public:
  struct Scratch {
    KdStack stack;
    OperationMarks marks;
  };

  Okd(KdTree kd_tree, OperationTree operation_tree)
      : kd_tree_(std::move(kd_tree)), operation_tree_(std::move(operation_tree)) {}

  void traverse(Walk& walk, Scratch& scratch) const {
    TraversalCounters& counters = walk.counters();
    scratch.marks.start(operation_tree_);
    counters.cells_visited += walk_kd_tree(kd_tree_, walk.ray(), scratch.stack, [&](const KdNode& leaf, double) {
      for (const std::uint32_t item : kd_tree_.items_of(leaf)) {
        if (!scratch.marks.mark(item)) ++counters.mailbox_hits;
      }
      return false;
    });
    scratch.marks.for_each_leaf([&](LeafId leaf) { walk.reveal(leaf); });
  }

  std::size_t memory_bytes() const { return kd_tree_.memory_bytes() + operation_tree_.memory_bytes(); }
  std::size_t boxes() const { return kd_tree_.nodes.size(); }
  int depth() const { return kd_tree_.depth; }

 private:
  KdTree kd_tree_;  // its items are nodes of the operation tree
  OperationTree operation_tree_;
};

}  // namespace

Result<std::unique_ptr<Accelerator>> build_okd(const BuildInput& input, AcceleratorOptions& options) {
  const KdOptions kd = take_kd_options(options);
  const bool clip = options.take_switch("clip", true);
  const bool skip = options.take_switch("skip", true);
  if (Status status = options.finish(); !status) return status.error();

  OperationTree operation_tree(input.tree, skip);
  std::vector<KdItem> items;
  for (const EnclosedLeaf& l : enclosed_leaves(input.tree, clip)) {
    const double test = cost(input.tree.primitives, input.tree[l.leaf].primitive);
    items.push_back({operation_tree.node_of(l.leaf), l.box, test});
  }
  return std::unique_ptr<Accelerator>(std::make_unique<StructureAccelerator<Okd>>(
      input.tree, Okd(build_kd_tree(items, kd), std::move(operation_tree))));
}

}  // namespace tenon
