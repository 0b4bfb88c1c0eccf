#pragma once

#include "plane/outline_figures.h"
#include "plane/recover.h"
#include "primitive/check.h"

namespace tenon {

/// An operation of Clipper's on polygons, by default oriented ones.
inline ClipperLib::Paths clip(ClipperLib::ClipType type, const ClipperLib::Paths& subjects,
                              const ClipperLib::Paths& clips, ClipperLib::PolyFillType fill = ClipperLib::pftNonZero) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(subjects, ClipperLib::ptSubject, true);
  clipper.AddPaths(clips, ClipperLib::ptClip, true);
  ClipperLib::Paths result;
  clipper.Execute(type, result, fill, fill);
  return result;
}

/// Whether there is a grid for coordinates up to this; outlines smaller or larger than primitives may be are none.
inline bool has_grid(double largest) {
  return largest >= smallest_size && largest <= largest_size;
}

}  // namespace tenon
