#include "accel/indexed_boxes.h"
#include "accel/structure.h"

namespace tenon {

namespace {

/// Bouatouch, Madani, Priol, Arnaldi: "A new algorithm of space tracing using a CSG model" (INRIA RR-612, 1987).
///
/// Space is halved along x, y and z in turn, by minimum enclosures; each box gets the CSG tree projected on it; the
/// spatial index SI finds the box of a point; rays push from box to box; mailboxes are the classifier's.
///
/// Where the paper leaves something open: the space is the hull of the minimum enclosures. An observer outside it
/// starts where the ray enters. Primary rays are filtered by the rectangle when the view is known, and by the sphere,
/// like all others, when it is not; without a view there are no axes of the eye either, and `axes=eye` means the
/// world's. The paper's user chooses levels and primitives; when nobody does, usual_level() and its own 2 primitives a
/// box.
class SpaceTracing {
 public:
  struct Scratch {};

  explicit SpaceTracing(IndexedBoxes boxes) : boxes_(std::move(boxes)) {}

  void traverse(Walk& walk, Scratch&) const { boxes_.trace(walk); }

  std::size_t memory_bytes() const { return boxes_.memory_bytes(); }
  std::size_t boxes() const { return boxes_.size(); }
  int depth() const { return boxes_.depth(); }

 private:
  IndexedBoxes boxes_;
};

}  // namespace

Result<std::unique_ptr<Accelerator>> build_space_tracing(const BuildInput& input, AcceleratorOptions& options) {
  const Levels wanted = take_levels(options, "levels", usual_level(input.tree.leaves.size()), highest_level);
  SubdivisionLimits limits;
  limits.primitives = static_cast<std::size_t>(options.take_integer("primitives", 2, 1, 1000000));
  const bool eye = options.take_word("axes", {"world", "eye"}) == 1;
  if (Status status = options.finish(); !status) return status.error();

  IndexedBoxes indexed;
  SubdividedSpace space(input.tree, chosen_axes(eye, input.view));
  if (!space.empty()) {
    limits.levels = space.levels(wanted);
    limits.held = SubdivisionLimits::usual_held(space.primitives.size());
    const std::vector<MidpointBox> boxes = subdivide(midpoint_grid(space.box, limits.levels),
                                                     space.root(subtree_of(input.tree)), limits, space.projection);
    Result<IndexedBoxes> built = IndexedBoxes::build("space-tracing", "choose fewer levels, or space-tracing-subgrids",
                                                     space, boxes, true, input.view);
    if (!built) return built.error();
    indexed = std::move(*built);
  }
  return std::unique_ptr<Accelerator>(
      std::make_unique<StructureAccelerator<SpaceTracing>>(input.tree, SpaceTracing(std::move(indexed))));
}

}  // namespace tenon
