#pragma once

#include <array>
#include <span>

#include "accel/cells/folded_table.h"
#include "accel/cells/leaf_regions.h"
#include "accel/cells/split_plane.h"

namespace tenon::cells {

/// Up to six leaves side by side, so that where a box lies with respect to all of them takes a few vector operations.
struct LeafLanes {
  static constexpr std::size_t width = 8;
  using Lane = std::array<double, width>;

  struct Axis {
    alignas(64) Lane center{};
    alignas(64) Lane round{};  ///< 1 where distances along the axis count, else 0
    alignas(64) Lane low{};    ///< what does not reach from here
    alignas(64) Lane high{};   ///< to here is outside,
    alignas(64) Lane inner_low{};
    alignas(64) Lane inner_high{};  ///< and only what lies between these may be inside
  };
  std::array<Axis, 3> axes;
  alignas(64) Lane outer_square{};
  alignas(64) Lane inner_square{};
  std::uint32_t shaped = 0;  ///< the leaves that are not plain, a bit each: of them only the bounds stand here

  void set(std::size_t lane, const RegionLeaf& leaf, double margin);
};

/// Where the two sides of a plane through a box lie.
using SideRegions = std::array<TableRegions, 2>;

/// @param box     of the world, bounded
/// @param growth  either side is taken to reach as far beyond its plane
/// @param sides   one for each plane
void classify_sides(const LeafLanes& leaves, const Box3& box, std::span<const SplitPlane> planes, double growth,
                    std::span<SideRegions> sides);

}  // namespace tenon::cells
