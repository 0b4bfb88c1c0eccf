#pragma once

#include "mesh/polygon_soup.h"

namespace tenon {

/// Heights at the points of a lattice, row after row.
struct Heights {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
  double bottom = 0;  ///< 1 below the lowest that the file gives, but not above 0
};

/// The luminance of a PNG picture, from 0 to 255, the top row first; what is transparent counts as its colour.
/// @param most_points  a picture of more is an error
Result<Heights> read_png_heights(const MeshFile& file, std::size_t most_points);

}  // namespace tenon
