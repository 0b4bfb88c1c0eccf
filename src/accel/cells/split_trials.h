#pragma once

#include <span>
#include <vector>

#include "accel/cells/leaf_lanes.h"
#include "accel/cells/leaf_regions.h"
#include "accel/cells/local_expression.h"
#include "accel/cells/split_plane.h"

namespace tenon::cells {

/// What planes through a part of space cost, in which any number of leaves have a boundary: the expression folded on
/// both sides. The leaves are classified by vectors for all planes at once.
class SplitTrials {
 public:
  /// @param growth  boxes are classified grown by as much (CellScale)
  SplitTrials(const LeafRegions& regions, const OwnerRanks& ranks, double growth)
      : regions_(regions), growth_(growth), folder_(ranks) {}

  /// @param leaves  of the expression, in its order
  void prepare(const LocalExpression& expression, std::span<const LeafId> leaves, const Box3& box,
               std::span<const SplitPlane> planes);

  /// Of the cell that one side of a plane would be; 0 where nothing is left.
  /// @param side  0: below the plane. `box` is that side of the part
  double folded_cost(std::size_t plane, std::size_t side, const Box3& box);

 private:
  const LeafRegions& regions_;
  double growth_;
  LocalExpression expression_;  // whose leaves are numbered in its own order
  std::vector<const RegionLeaf*> leaves_;
  std::vector<LeafLanes> groups_;   // of the leaves
  std::vector<SideRegions> sides_;  // group by group, of each plane
  std::size_t plane_count_ = 0;
  Folder folder_;
  LocalExpression folded_;
};

}  // namespace tenon::cells
