#include "accel/space_boxes.h"
#include "accel/spatial_index.h"
#include "accel/structure.h"
#include "accel/subdivided_space.h"

namespace tenon {

namespace {

/// RR-612 §6: space tracing with two levels of grids, after Tamminen, Karonen and Mäntylä 1984. The maximum levels of
/// the first grid are small; each box that has reached them and still holds many primitives gets a sub-grid, in which
/// the subdivision goes on. An element of the first grid points to a box, or to a sub-grid, which points to a box.
///
/// Where the paper leaves something open: `levels` and `sublevels` are the maximum levels of the two, together
/// usual_level() and one more when nobody chooses, since a sub-grid costs memory only where it stands; "many
/// primitives" are more than `primitives`, as for any box; a sub-grid has the levels that were reached in it. All boxes
/// are made of the smallest boxes of all sub-grids, so a ray steps through both levels by the same numbers, and a
/// sub-grid takes as many of their upper bits as it has levels.
class SpaceTracingSubgrids {
 public:
  struct Scratch {};
  using Number = SpatialIndex::Number;

  SpaceTracingSubgrids() = default;

  /// @param limits     of the first grid
  /// @param sublevels  how much deeper sub-grids may go
  static Result<SpaceTracingSubgrids> build(const BuildInput& input, SubdividedSpace& space, SubdivisionLimits limits,
                                            const Levels& sublevels);

  void traverse(Walk& walk, Scratch&) const {
    boxes_.trace(walk, [this](const CellIndex& cell) { return box_of(cell); });
  }

  std::size_t memory_bytes() const {
    return boxes_.memory_bytes() + first_.memory_bytes() + subgrids_.capacity() * sizeof(SpatialIndex) + subgrid_bytes_;
  }
  std::size_t boxes() const { return boxes_.size(); }
  int depth() const { return boxes_.depth(); }

 private:
  static constexpr Number is_subgrid = Number{1} << 31;  // marks elements of the first grid

  Number box_of(const CellIndex& cell) const {
    CellIndex upper;
    for (std::size_t a = 0; a < 3; ++a) upper[a] = cell[a] >> sublevels_[a];
    const Number element = first_.at(upper);
    if ((element & is_subgrid) == 0) return element;
    const SpatialIndex& subgrid = subgrids_[element & ~is_subgrid];
    CellIndex lower;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::uint32_t within = cell[a] & ((1u << sublevels_[a]) - 1);
      lower[a] = within >> (sublevels_[a] - subgrid.levels()[a]);
    }
    return subgrid.at(lower);
  }

  // @param place   the element of the first grid
  // @param levels  of the sub-grid
  void add_subgrid(const CellRange& place, const Levels& levels, const std::vector<MidpointBox>& boxes,
                   Projection& projection);

  Levels sublevels_{};
  SpaceBoxes boxes_;
  SpatialIndex first_;
  std::vector<SpatialIndex> subgrids_;
  std::size_t subgrid_bytes_ = 0;
};

Levels sum(const Levels& a, const Levels& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Levels difference(const Levels& a, const Levels& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Result<SpaceTracingSubgrids> SpaceTracingSubgrids::build(const BuildInput& input, SubdividedSpace& space,
                                                         SubdivisionLimits limits, const Levels& sublevels) {
  const char* const name = "space-tracing-subgrids";
  const char* const advice = "choose fewer levels or sublevels";
  const Levels first_levels = limits.levels;
  const Levels all_levels = sum(first_levels, sublevels);
  if (Status fits = check_index_bytes(name, SpatialIndex::memory_bytes(first_levels), advice); !fits) {
    return fits.error();
  }
  SpaceTracingSubgrids result;
  const GridGeometry grid = midpoint_grid(space.box, all_levels);
  result.sublevels_ = sublevels;
  result.boxes_ = SpaceBoxes(grid, all_levels, space.axes, space.margin);
  result.boxes_.use_filters(input.view);
  result.first_ = SpatialIndex(first_levels);

  std::vector<MidpointBox> first =
      subdivide(midpoint_grid(space.box, first_levels), space.root(subtree_of(input.tree)), limits, space.projection);
  // What boxes may hold is shared out among the sub-grids by what they begin with.
  std::size_t held = 0;
  for (const MidpointBox& box : first) held += 1 + box.primitives;
  const double share = static_cast<double>(limits.held) / static_cast<double>(held);

  limits.levels = all_levels;
  for (MidpointBox& box : first) {
    const CellRange place = box.cells(first_levels);
    if (box.level != first_levels || box.primitives <= limits.primitives) {
      result.first_.fill(place, result.boxes_.add(box, space.projection));
      continue;
    }
    limits.held = static_cast<std::size_t>(share * static_cast<double>(1 + box.primitives));
    const std::vector<MidpointBox> inner = subdivide(grid, std::move(box), limits, space.projection);
    const Levels inner_levels = difference(highest_levels(inner), first_levels);
    result.subgrid_bytes_ += SpatialIndex::memory_bytes(inner_levels);
    if (Status fits = check_index_bytes(name, result.subgrid_bytes_, advice); !fits) return fits.error();
    result.add_subgrid(place, inner_levels, inner, space.projection);
  }
  return result;
}

void SpaceTracingSubgrids::add_subgrid(const CellRange& place, const Levels& levels,
                                       const std::vector<MidpointBox>& boxes, Projection& projection) {
  const Levels smallest = sum(first_.levels(), levels);
  SpatialIndex subgrid(levels);
  for (const MidpointBox& box : boxes) {
    CellRange cells = box.cells(smallest);
    for (std::size_t a = 0; a < 3; ++a) {
      cells.first[a] -= place.first[a] << levels[a];
      cells.last[a] -= place.first[a] << levels[a];
    }
    subgrid.fill(cells, boxes_.add(box, projection));
  }
  first_.fill(place, static_cast<Number>(subgrids_.size()) | is_subgrid);
  subgrids_.push_back(std::move(subgrid));
}

}  // namespace

Result<std::unique_ptr<Accelerator>> build_space_tracing_subgrids(const BuildInput& input,
                                                                  AcceleratorOptions& options) {
  const int usual = usual_level(input.tree.leaves.size()) + 1;
  const Levels wanted = take_levels(options, "levels", usual / 2, highest_level);
  const Levels subwanted = take_levels(options, "sublevels", usual - usual / 2, highest_level);
  SubdivisionLimits limits;
  limits.primitives = static_cast<std::size_t>(options.take_integer("primitives", 2, 1, 1000000));
  const bool eye = options.take_word("axes", {"world", "eye"}) == 1;
  if (Status status = options.finish(); !status) return status.error();

  SpaceTracingSubgrids structure;
  SubdividedSpace space(input.tree, chosen_axes(eye, input.view));
  if (!space.empty()) {
    limits.levels = space.levels(wanted);
    limits.held = SubdivisionLimits::usual_held(space.primitives.size());
    const Levels sublevels = difference(space.levels(sum(limits.levels, subwanted)), limits.levels);
    Result<SpaceTracingSubgrids> built = SpaceTracingSubgrids::build(input, space, limits, sublevels);
    if (!built) return built.error();
    structure = std::move(*built);
  }
  return std::unique_ptr<Accelerator>(
      std::make_unique<StructureAccelerator<SpaceTracingSubgrids>>(input.tree, std::move(structure)));
}

}  // namespace tenon
