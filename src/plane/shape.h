#pragma once

#include <vector>

#include "tenon/primitive/outline.h"

namespace tenon {

/// A Boolean expression over outlines.
struct Shape {
  enum class Operation { outline, unite, intersect, subtract };

  Operation operation = Operation::unite;
  Outline outline;           ///< of Operation::outline
  std::vector<Shape> parts;  ///< of the others; those after the first are subtracted from it

  static Shape of(Outline outline) { return {Operation::outline, std::move(outline), {}}; }
};

/// The outline of a shape, in segments and arcs: loops turn to the left around what they enclose, and do not cross.
///
/// Polygons decide what meets what (Clipper), with a grid of 2⁻⁴⁸ and chords within 2⁻¹⁵ of the largest coordinate;
/// corners are then found on the segments and arcs themselves, so that the outline is exact, but for boundaries of arcs
/// nearer than 2⁻¹⁵ to one another.
/// @return no loops where nothing is enclosed, or all is smaller or larger than a primitive may be (1e-60 to 1e60)
Outline resolve(const Shape& shape);

/// The same of loops in which a point is inside that they wind around at all, as fonts have it.
Outline resolve_winding(const Outline& outline);

}  // namespace tenon
