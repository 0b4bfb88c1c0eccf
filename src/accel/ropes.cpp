#include "accel/all.h"
#include "accel/bsp_options.h"
#include "accel/rope_walk.h"

namespace tenon {

/// BSP tree with ropes (Křivánek & Bubník, "Ropes"): the exit face's rope leads to the smallest node that holds all
/// its neighbours, and the exit point chooses among them on the way down.
///
/// Left open by the paper: which cell a ray that passes exactly through an edge enters first (the one across the first
/// of the axes), and how a remembered cell is known to be the right one (it must hold the ray's origin).
Result<std::unique_ptr<Accelerator>> build_ropes(const BuildInput& input, AcceleratorOptions& options) {
  const BspOptions bsp = take_bsp_options(options);
  const bool mailbox = options.take_switch("mailbox", true);
  if (Status status = options.finish(); !status) return status.error();
  RopedBsp roped(build_bsp_tree(input.tree, bsp));
  return std::unique_ptr<Accelerator>(
      std::make_unique<StructureAccelerator<RopeWalk>>(input.tree, RopeWalk(std::move(roped), mailbox)));
}

}  // namespace tenon
