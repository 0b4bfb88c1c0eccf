#pragma once

#include "base/input_file.h"
#include "drawing/drawing.h"
#include "tenon/base/error.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// Whether a file is a drawing, by the ending of its name: DXF.
bool is_drawing(const std::string& path);

/// Reads a drawing file.
/// @return an error of kind input with its place in the file, or of kind machine when the file cannot be read
Result<Drawing> load_drawing(const std::string& path);

/// The same of a file that has been read.
Result<Drawing> parse_drawing(const InputFile& file);

/// Reads DXF as text: LINE, LWPOLYLINE, POLYLINE, CIRCLE, ARC, ELLIPSE, SPLINE, INSERT of BLOCKs, and DIMENSION. As in
/// OpenSCAD, what an INSERT shows lies on the layer of the INSERT.
Result<Drawing> read_dxf(const InputFile& file);

/// Moves a drawing so that `origin` lies at 0, and scales it.
void place(Drawing& drawing, const Vec2& origin, double scale);

/// What the closed paths of a layer enclose, by the even-odd rule.
struct DrawnOutline {
  Outline outline;
  std::size_t open_paths = 0;  ///< that were closed by a segment, as OpenSCAD does
};

/// @param layer  its name; empty for all of them
DrawnOutline outline_of_layer(const Drawing& drawing, const std::string& layer);

/// What `dxf_dim` measures: a length, or an angle in degrees.
/// @param name  of the dimension; empty for the first one
/// @return an error (without place) where there is none, or of a type that cannot be measured
Result<double> measure(const Drawing& drawing, const std::string& layer, const std::string& name);

/// Where the two lines of a layer cross.
/// @return an error (without place) where there are no two that do
Result<Vec2> crossing(const Drawing& drawing, const std::string& layer);

}  // namespace tenon
