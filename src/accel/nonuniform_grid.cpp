#include "accel/indexed_boxes.h"
#include "accel/structure.h"

namespace tenon {

namespace {

/// Bouatouch, course, "Subdivision into a non uniform grid": cells halved at their middle along x, y and z in turn, a
/// linear array of them with lists of objects, and the next cell by pushing half a smallest cell along the normals of
/// the faces the ray leaves through.
///
/// Where the course leaves something open: objects are sought by their minimum enclosures; the cell of a point is found
/// by a grid of cell numbers, as in RR-612, which describes the same subdivision; the maximum level is usual_level()
/// and the minimum number of objects 2. The course has no mailboxes: `mailbox=off` shows what that costs.
class NonuniformGrid {
 public:
  struct Scratch {};

  NonuniformGrid(IndexedBoxes cells, bool mailbox) : cells_(std::move(cells)), mailbox_(mailbox) {}

  void traverse(Walk& walk, Scratch&) const {
    walk.use_mailbox(mailbox_);
    cells_.trace(walk);
  }

  std::size_t memory_bytes() const { return cells_.memory_bytes(); }
  std::size_t boxes() const { return cells_.size(); }
  int depth() const { return cells_.depth(); }

 private:
  IndexedBoxes cells_;
  bool mailbox_;
};

}  // namespace

Result<std::unique_ptr<Accelerator>> build_nonuniform_grid(const BuildInput& input, AcceleratorOptions& options) {
  const Levels wanted = take_levels(options, "levels", usual_level(input.tree.leaves.size()), highest_level);
  SubdivisionLimits limits;
  limits.primitives = static_cast<std::size_t>(options.take_integer("primitives", 2, 1, 1000000));
  const bool mailbox = options.take_switch("mailbox", true);
  if (Status status = options.finish(); !status) return status.error();

  IndexedBoxes cells;
  SubdividedSpace space(input.tree, SpaceAxes::world());
  if (!space.empty()) {
    limits.levels = space.levels(wanted);
    limits.held = SubdivisionLimits::usual_held(space.primitives.size());
    const std::vector<MidpointBox> boxes = subdivide(
        midpoint_grid(space.box, limits.levels), space.root(subtree_of(space.primitives)), limits, space.projection);
    Result<IndexedBoxes> built =
        IndexedBoxes::build("nonuniform-grid", "choose fewer levels", space, boxes, false, nullptr);
    if (!built) return built.error();
    cells = std::move(*built);
  }
  return std::unique_ptr<Accelerator>(
      std::make_unique<StructureAccelerator<NonuniformGrid>>(input.tree, NonuniformGrid(std::move(cells), mailbox)));
}

}  // namespace tenon
