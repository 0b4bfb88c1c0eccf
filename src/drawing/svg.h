#pragma once

#include <string>
#include <vector>

#include "base/input_file.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// How an SVG file is read.
struct SvgOptions {
  double dpi = 72;  ///< of the page's lengths without a unit; OpenSCAD's default
  bool center = false;
  std::string id;     ///< of the only element to take; empty for all
  std::string layer;  ///< of the only layer (Inkscape's) to take; empty for all
};

/// What an SVG file fills, in millimetres, the page's lower left corner at the origin.
struct SvgPicture {
  Outline outline;
  std::vector<std::string> notes;  ///< what was left out, for a warning each
};

/// Reads paths, rectangles, circles, ellipses, polygons and polylines, groups, transforms and `use`. As in OpenSCAD
/// what is closed is filled; open lines that are not filled are left out, and so are texts and pictures.
/// @return an error of kind input with its place in the file
Result<SvgPicture> read_svg(const InputFile& file, const SvgOptions& options);

}  // namespace tenon
