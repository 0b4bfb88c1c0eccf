#pragma once

#include <ft2build.h>
#include FT_FREETYPE_H

#include "tenon/primitive/outline.h"

namespace tenon {

/// An outline of FreeType's, in its coordinates.
/// @param tolerance  of arcs for its curves
/// @param segments   a curve; 0 for arcs
Outline glyph_outline(FT_Outline& outline, double tolerance, int segments);

}  // namespace tenon
