#include "accel/indexed_boxes.h"

namespace tenon {

Result<IndexedBoxes> IndexedBoxes::build(const std::string& structure, const std::string& instead,
                                         SubdividedSpace& space, const std::vector<MidpointBox>& boxes, bool filters,
                                         const ScreenView* view) {
  const Levels levels = highest_levels(boxes);
  if (Status fits = check_index_bytes(structure, SpatialIndex::memory_bytes(levels), instead); !fits) {
    return fits.error();
  }
  IndexedBoxes result;
  result.boxes_ = SpaceBoxes(midpoint_grid(space.box, levels), levels, space.axes, space.margin);
  if (filters) result.boxes_.use_filters(view);
  result.boxes_.reserve(boxes);
  result.index_ = SpatialIndex(levels);
  for (const MidpointBox& box : boxes) result.index_.fill(box.cells(levels), result.boxes_.add(box, space.projection));
  return result;
}

}  // namespace tenon
