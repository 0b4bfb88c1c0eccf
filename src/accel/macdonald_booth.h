#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "csg/enclosures.h"

namespace tenon {

/// A plane across an axis.
struct AxisPlane {
  int axis = 0;
  double position = 0;
};

/// Chooses planes by the surface area heuristic of MacDonald & Booth, "Heuristics for ray tracing using space
/// subdivision", The Visual Computer 6 (1990): least is SA(below) * n(below) + SA(above) * n(above). They show that the
/// least lies between the middle of the cell and the plane with half of the objects on either side; so the planes
/// tried are the bounds of boxes between those two, and the two. The axis is the one whose best plane is best.
class MacDonaldBooth {
 public:
  /// @return nothing when no plane lies strictly within the cell
  std::optional<AxisPlane> choose(const std::vector<EnclosedLeaf>& leaves, const std::vector<std::uint32_t>& items,
                                  const Box3& cell);

 private:
  void try_plane(const Box3& cell, const AxisPlane& plane);

  std::vector<double> lowers_, uppers_, centers_;  // of the items along one axis; kept to spare allocations
  std::optional<AxisPlane> best_;
  double best_cost_ = 0;
};

}  // namespace tenon
