#pragma once

#include <string>

#include "accel/all.h"
#include "accel/midpoint_subdivision.h"
#include "accel/space_axes.h"

namespace tenon {

/// The space that RR-612 and the course subdivide, and what stands in it.
struct SubdividedSpace {
  SubdividedSpace(const CsgTree& tree, const SpaceAxes& axes);

  SpaceAxes axes;
  double margin;                   ///< enclosure_margin() of the scene
  Projection projection;           ///< on minimum enclosures along the axes
  Box3 box;                        ///< the hull of those, with room around it
  std::vector<LeafId> primitives;  ///< the bounded leaves that can matter

  bool empty() const { return primitives.empty(); }

  /// The levels asked for, as far as they make sense here: boxes thinner than the margin separate nothing.
  Levels levels(const Levels& wanted) const { return useful_levels(wanted, box, 4 * margin); }

  /// The whole space as one box, with a subtree.
  MidpointBox root(Subtree subtree) const { return {{}, {}, std::move(subtree), primitives.size()}; }
};

/// The axes that a structure's `axes` option names: the eye's only when there is a view, else the world's.
SpaceAxes chosen_axes(bool eye, const ScreenView* view);

/// Takes `KEY`, a level for all axes, and `KEY_x`, `KEY_y`, `KEY_z`, for one.
Levels take_levels(AcceleratorOptions& options, const std::string& key, int fallback, int highest);

}  // namespace tenon
