#pragma once

#include "tenon/primitive/outline.h"

namespace tenon {

/// How the gap is filled that opens at a corner when its edges move apart.
enum class OffsetJoin {
  round,    ///< by an arc around the corner
  miter,    ///< by going on straight until the edges meet
  chamfer,  ///< by a straight edge at the offset's distance from the corner
};

/// Moves every edge of an outline outward by a distance, or inward where it is negative. Segments and arcs stay
/// segments and arcs.
/// @param outline  as resolve() returns it
/// @return no loops where nothing is left
Outline offset(const Outline& outline, double distance, OffsetJoin join);

}  // namespace tenon
