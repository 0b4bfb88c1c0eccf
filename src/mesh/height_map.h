#pragma once

#include "mesh/polygon_soup.h"

namespace tenon {

/// How surface() of the scene language places a height map.
struct HeightMapOptions {
  bool center = false;  ///< around x = y = 0 instead of from there
  bool invert = false;  ///< of a picture: dark is high
};

/// Heights at the points of a lattice, as OpenSCAD's surface() reads them: a PNG picture by its luminance, from 0 to
/// 100, the last row at y = 0; or text with a row a line, the first at y = 0, where `#` begins a comment and what is
/// missing at the end of a row is 0. Between four points lie four triangles that meet in their middle, and below them a
/// flat bottom at 0 or 1 below the lowest point, whichever is lower.
///
/// @return an error of kind input where there are fewer than two rows or columns, or too many, or what is no number
Result<PolygonSoup> read_height_map(const MeshFile& file, const HeightMapOptions& options);

}  // namespace tenon
