#pragma once

#include "plane/chords.h"

namespace tenon {

/// The outline whose polygons Clipper made of those in `chords`: chords become the arcs they are of again, and corners
/// that Clipper found are moved to where the curves themselves meet. What is thinner than Clipper's rounding is left
/// out.
///
/// Loops turn to the left around what they enclose, if the polygons do, and no two edges cross.
Outline recover_outline(const Chords& chords, const ClipperLib::Paths& paths);

}  // namespace tenon
