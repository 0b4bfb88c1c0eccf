#pragma once

namespace tenon::bench {

/// How far a mesh may lie from its surface so that its silhouette is wrong by less than a quarter of a pixel.
///
/// At depth z before a perspective camera the picture's width covers 2 z tan(fov / 2), so a pixel is that over the
/// number of columns. A chord that lies e inside of the surface moves the outline by e at most, seen square on.
/// @param half_width  tan(fov / 2), as ScreenView has it
/// @param columns     of the picture
/// @param depth       of the nearest part of the surface, along the view
/// @return e, in the scene's units
constexpr double chord_error(double half_width, int columns, double depth) {
  return 0.25 * 2 * depth * half_width / columns;
}

}  // namespace tenon::bench
