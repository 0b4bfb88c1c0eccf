#pragma once

#include <cstdint>
#include <span>

#include "render/integrator.h"
#include "tenon/image/picture.h"
#include "tenon/render/depth_cut.h"

namespace tenon {

/// What the limit of the depth cut off of a tile.
struct TileCut {
  PixelWindow tile;
  std::uint64_t samples = 0;  ///< of all its pixels together
  CutPaths paths;
};

/// What that comes to.
DepthCut depth_cut(std::span<const TileCut> tiles);

}  // namespace tenon
