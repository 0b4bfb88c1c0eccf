#include "accel/all.h"
#include "accel/bsp_options.h"
#include "accel/rope_walk.h"

namespace tenon {

/// BSP tree with rope trees (Křivánek & Bubník, "Rope trees"): every rope to an inner node is replaced by a copy of its
/// subtree pruned to the face.
///
/// Left open by the paper: a bound on memory. It reports eight times the plain tree's; here rope trees stop at 32 nodes
/// for each node of the tree, and the ropes not yet replaced stay indirect.
Result<std::unique_ptr<Accelerator>> build_rope_trees(const BuildInput& input, AcceleratorOptions& options) {
  constexpr std::size_t nodes_per_node = 32;
  const BspOptions bsp = take_bsp_options(options);
  const bool mailbox = options.take_switch("mailbox", true);
  if (Status status = options.finish(); !status) return status.error();
  RopedBsp roped(build_bsp_tree(input.tree, bsp));
  roped.plant_rope_trees(nodes_per_node * roped.nodes().size());
  return std::unique_ptr<Accelerator>(
      std::make_unique<StructureAccelerator<RopeWalk>>(input.tree, RopeWalk(std::move(roped), mailbox)));
}

}  // namespace tenon
