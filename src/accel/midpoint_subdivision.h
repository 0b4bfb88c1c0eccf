#pragma once

#include <cstddef>
#include <vector>

#include "accel/grid_geometry.h"
#include "accel/projection.h"

namespace tenon {

/// How often space has been halved along each axis.
using Levels = std::array<int, 3>;

/// The most levels that may be asked for: numbers of cells stay well below what 32 bits hold, also with sub-grids.
inline constexpr int highest_level = 10;

/// A box of the subdivision of space (RR-612 §3.3). Its size follows from address and level.
struct MidpointBox {
  CellIndex address{};  ///< its number among the boxes of its level, from 0
  Levels level{};
  Subtree subtree;             ///< the CSG tree projected on it
  std::size_t primitives = 0;  ///< the bounded leaves of the subtree

  /// The smallest boxes it is made of, where space is halved `smallest` times.
  CellRange cells(const Levels& smallest) const;
};

/// Where the subdivision stops.
struct SubdivisionLimits {
  Levels levels{};             ///< the maximum level with respect to each axis
  std::size_t primitives = 1;  ///< a box with no more than these is not split
  /// The most boxes, and primitives in them, that there may be: what bounds memory where splitting separates nothing.
  std::size_t held = 0;

  static std::size_t usual_held(std::size_t primitives) { return (std::size_t{1} << 20) + 32 * primitives; }
};

/// Subdivides space by halving boxes along x, y and z, one after the other (RR-612 §3.1; course, "Subdivision into a
/// non uniform grid"), and keeps the leaves of that process, in the order of their halvings.
///
/// An axis whose level is reached is passed over; a box is split until it holds few enough primitives or no axis is
/// left. A child's projection is that of its parent's subtree, which is the same as projecting the whole tree and costs
/// only what is left of it. The primitives that count are those of the projection: the paper counts enclosures, but one
/// that the projection dropped needs no further separating.
///
/// @param grid  the smallest boxes: 2^limits.levels of them along each axis
/// @param root  the box to split; its address and level are those of `grid`, so that a sub-grid continues its box
std::vector<MidpointBox> subdivide(const GridGeometry& grid, MidpointBox root, const SubdivisionLimits& limits,
                                   Projection& projection);

/// The highest level that any of the boxes has reached along each axis.
Levels highest_levels(const std::vector<MidpointBox>& boxes);

/// The grid of the smallest boxes of a space.
GridGeometry midpoint_grid(const Box3& space, const Levels& levels);

/// The levels asked for, less where an axis is so short that the smallest boxes would be thinner than `thinnest`: flat
/// scenes are not halved along their flat axis.
Levels useful_levels(const Levels& wanted, const Box3& space, double thinnest);

/// The level that a number of primitives calls for when nobody chose: a grid of about 8 elements per primitive, and
/// from 8 to 256 along an axis. That is what RR-612 chose for its pictures (table 2), to within one.
int usual_level(std::size_t primitives);

}  // namespace tenon
