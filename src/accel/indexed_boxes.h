#pragma once

#include <string>
#include <vector>

#include "accel/space_boxes.h"
#include "accel/spatial_index.h"
#include "accel/subdivided_space.h"

namespace tenon {

/// The boxes of a subdivision, found by one grid of their numbers: the non-uniform grid of the course and RR-612's SI.
///
/// The grid has the levels that were reached, which may be less than those that were allowed.
class IndexedBoxes {
 public:
  IndexedBoxes() = default;

  /// @param structure  its name, and what to do `instead` when the grid would be too large: for the error
  /// @param filters    whether boxes get enclosing volumes, for the view when there is one
  static Result<IndexedBoxes> build(const std::string& structure, const std::string& instead, SubdividedSpace& space,
                                    const std::vector<MidpointBox>& boxes, bool filters, const ScreenView* view);

  void trace(Walk& walk) const {
    boxes_.trace(walk, [this](const CellIndex& cell) { return index_.at(cell); });
  }

  std::size_t memory_bytes() const { return boxes_.memory_bytes() + index_.memory_bytes(); }
  std::size_t size() const { return boxes_.size(); }
  int depth() const { return boxes_.depth(); }

 private:
  SpaceBoxes boxes_;
  SpatialIndex index_;
};

}  // namespace tenon
