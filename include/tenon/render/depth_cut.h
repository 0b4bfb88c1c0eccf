#pragma once

#include <cstdint>

#include "tenon/image/picture.h"

namespace tenon {

/// What --depth has cut off of a picture by path tracing: light that would have come along longer paths.
///
/// How much that is follows from how the light falls off from the last but one to the last quarter of the depth, as if
/// it went on like that (Aitken's extrapolation). That paths still carry something says little: within a block of glass
/// many are reflected totally for ever, and no light ever comes along them. Depths below 4 have no such quarters, and
/// nothing is known of what they cut.
struct DepthCut {
  std::uint64_t paths = 0;   ///< that ended there
  double share = 0;          ///< of the picture's light, 0 to 1
  double largest_share = 0;  ///< of a tile's light, less two standard errors
  PixelWindow tile;          ///< that one

  /// From this share on light is lost that may be seen: encoded for a display, light is raised to 1 / 2.4, so that this
  /// moves the brightest component by one step of 8 bits.
  static constexpr double visible_share = 2.4 / 255;
  bool may_be_seen() const { return largest_share > visible_share; }
};

}  // namespace tenon
