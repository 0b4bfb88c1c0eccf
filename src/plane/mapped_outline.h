#pragma once

#include "tenon/math/affine3.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// Whether a map takes circles of the plane z = 0 to circles, but for its own rounding.
bool keeps_circles(const Affine3& map);

/// The image of an outline under the part of a map in the plane. Arcs stay arcs where circles stay circles; else an
/// ellipse becomes arcs that keep within 2⁻²⁰ of its size.
Outline mapped(const Outline& outline, const Affine3& map);

}  // namespace tenon
