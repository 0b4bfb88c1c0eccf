#pragma once

#include <array>
#include <span>
#include <vector>

#include "accel/cells/folded_table.h"
#include "accel/cells/leaf_lanes.h"
#include "accel/cells/leaf_regions.h"
#include "accel/cells/split_plane.h"

namespace tenon::cells {

/// A plane through a part of space, and what is left of the expression on its two sides.
struct Split {
  SplitPlane plane;
  std::array<FoldedTable, 2> rests;
};

/// Looks for planes through parts of space in which up to six leaves have a boundary: the surface area heuristic on the
/// folded expression.
class SplitSearch {
 public:
  static constexpr std::size_t most = TruthTable::most_variables;

  /// @param growth  boxes are classified grown by as much (CellScale)
  /// @param beside  how many evenly spaced planes are tried on either side of the middle
  SplitSearch(const LeafRegions& regions, double growth, int beside)
      : regions_(regions), growth_(growth), beside_(beside) {}

  /// From now on the leaves are these.
  void assign(std::span<const LeafId> leaves);

  const RegionLeaf& leaf(std::size_t i) const { return leaves_[i]; }
  /// Of a cell with a boundary of these leaves, a bit each.
  double cell_cost(std::uint32_t leaves) const { return cell_cost_[leaves]; }

  Split best_split(const Box3& box, const FoldedTable& rest);

 private:
  void list_planes(const Box3& box, std::uint32_t leaves);
  FoldedTable rest_in(const Box3& grown_side, const FoldedTable& rest, TableRegions regions) const;

  const LeafRegions& regions_;
  double growth_;
  int beside_;
  std::array<RegionLeaf, most> leaves_;
  LeafLanes lanes_;
  std::array<double, std::size_t{1} << most> cell_cost_;
  std::vector<SplitPlane> planes_;  // to try
  std::vector<SideRegions> sides_;  // of each
};

}  // namespace tenon::cells
