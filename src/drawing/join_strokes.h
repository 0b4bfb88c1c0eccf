#pragma once

#include "drawing/drawing.h"

namespace tenon {

/// Strokes that meet end to end, as one way.
struct Path {
  std::vector<OutlineCorner> corners;  ///< the bulge of the last one leads to the first, where the path is closed
  bool closed = false;
};

/// Joins strokes whose ends lie within `distance` of one another, in any order and sense. Paths begin at loose ends
/// first, as OpenSCAD's do; where several strokes meet, the first one of the drawing goes on.
std::vector<Path> join_strokes(const std::vector<Stroke>& strokes, double distance);

}  // namespace tenon
