#pragma once

#include <cstdint>

#include "tenon/image/picture.h"

namespace tenon {

/// What --depth has cut off of a picture by path tracing: paths that would have gone on.
///
/// How much light they would have brought nobody knows; what they carried of it, all surfaces before reckoned in, is
/// the share of the light that is lost if they would have met as much as others do. Where light cannot come, as within
/// a ball that reflects it totally on and on, nothing is.
struct DepthCut {
  std::uint64_t paths = 0;
  double share = 0;          ///< of the picture's light, 0 to 1
  double largest_share = 0;  ///< of a tile's light, less two standard errors
  PixelWindow tile;          ///< that one

  /// From this share on light is lost that may be seen: encoded for a display, light is raised to 1 / 2.4, so that this
  /// moves the brightest component by one step of 8 bits.
  static constexpr double visible_share = 2.4 / 255;
  bool may_be_seen() const { return largest_share > visible_share; }
};

}  // namespace tenon
