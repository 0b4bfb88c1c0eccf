#pragma once

#include "render/block.h"
#include "tenon/accel/screen_view.h"

namespace tenon {

/// How far a place of the picture lies from its middle, on the screen of the view.
/// @param x, y  as of CameraRays::ray()
inline Vec3 screen_offset(const ScreenView& view, double x, double y) {
  // 2x - width is exact at pixel centres, so the two halves of the picture are mirror images to the last bit.
  const double scale = view.half_width / view.width;
  return ((2 * x - view.width) * scale) * view.right + ((view.height - 2 * y) * scale) * view.up;
}

/// The direction through a place of the picture from an eye that is a point, length 1.
inline Vec3 primary_direction(const ScreenView& view, double x, double y) {
  return normalize(view.forward + screen_offset(view, x, y));
}

/// The same for the places of a block.
void find_primary_directions(const ScreenView& view, const NumberBlock& x, const NumberBlock& y, std::size_t count,
                             Vec3Block& direction);

}  // namespace tenon
