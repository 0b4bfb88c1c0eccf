#include <array>

#include "accel/all.h"
#include "accel/bsp_options.h"
#include "accel/structure.h"
#include "kdtree/ray_box.h"

namespace tenon {

namespace {

/// Binary space partition (Křivánek & Bubník, "Ray tracing with rope trees", section "Binary space partitioning"): the
/// tree is descended from its root, and where its plane cuts the ray's segment within a node, the far part waits on a
/// stack, as in a recursion.
///
/// Left open by the paper: what holds memory in bounds where primitives overlap (ReferenceBudget), and where exactly
/// MacDonald & Booth's planes are tried (MacDonaldBooth). ART's axes of the children, kept in the parent to choose a
/// procedure, are not kept: a switch on the axis costs less than a call today.
///
/// cells_visited counts nodes, inner ones and leaves; next_box_calls counts returns to a node that waited.
class Bsp {
 public:
  struct Scratch {
    struct Waiting {
      std::uint32_t node;
      double t_out;
    };
    std::array<Waiting, BspOptions::deepest> stack;
  };

  Bsp(BspTree tree, bool mailbox) : tree_(std::move(tree)), mailbox_(mailbox) {}

  void traverse(Walk& walk, Scratch& scratch) const {
    walk.use_mailbox(mailbox_);
    const Ray& ray = walk.ray();
    auto [t_in, t_out] = clip(BoxRay(ray), tree_.box);
    if (t_in > t_out) return;
    TraversalCounters& counters = walk.counters();
    std::size_t waiting = 0;
    std::uint32_t at = 0;
    for (;;) {
      const BspNode* node = &tree_.nodes[at];
      ++counters.cells_visited;
      // The parts of the ray on the two sides meet at the same computed t, so no stretch of it is left out.
      while (!node->is_leaf()) {
        const int axis = static_cast<int>(node->axis);
        const std::uint32_t near = side_of(*node, ray.origin, ray.direction);
        at = node->first + near;
        // From its start the ray moves away from the plane, or along it, unless this is positive.
        const double t = (node->plane - ray.origin[axis]) / ray.direction[axis];
        if (ray.direction[axis] != 0 && t > 0 && t < t_out) {
          const std::uint32_t far = node->first + 1 - near;
          if (t <= t_in) {
            at = far;
          } else {
            scratch.stack[waiting++] = {far, t_out};
            t_out = t;
          }
        }
        node = &tree_.nodes[at];
        ++counters.cells_visited;
      }
      const BspCell cell = tree_.cells[node->first];
      for (std::uint32_t i = 0; i < cell.item_count; ++i) walk.reveal(tree_.items[cell.first_item + i]);
      if (walk.settle(t_out) || waiting == 0) return;
      --waiting;
      ++counters.next_box_calls;
      at = scratch.stack[waiting].node;
      t_in = t_out;
      t_out = scratch.stack[waiting].t_out;
    }
  }

  std::size_t memory_bytes() const { return tree_.memory_bytes(); }
  std::size_t boxes() const { return tree_.nodes.size(); }
  int depth() const { return tree_.depth; }

 private:
  BspTree tree_;
  bool mailbox_;
};

}  // namespace

Result<std::unique_ptr<Accelerator>> build_bsp(const BuildInput& input, AcceleratorOptions& options) {
  const BspOptions bsp = take_bsp_options(options);
  const bool mailbox = options.take_switch("mailbox", true);
  if (Status status = options.finish(); !status) return status.error();
  return std::unique_ptr<Accelerator>(
      std::make_unique<StructureAccelerator<Bsp>>(input.tree, Bsp(build_bsp_tree(input.tree, bsp), mailbox)));
}

}  // namespace tenon
