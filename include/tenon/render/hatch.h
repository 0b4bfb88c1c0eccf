#pragma once

namespace tenon {

/// Lines across the cut faces of a section view, as draughtsmen draw them: each material has its own angle, and where
/// angles run out its own spacing.
struct HatchOptions {
  double angle = 45;       ///< of the first material's lines against the picture's horizontal, degrees
  double spacing = 0;      ///< between lines, of the first material; 0: chosen from the size of the solid
  bool in_pixels = false;  ///< the spacing is in pixels, and the lines lie in the picture; else in the cut's plane

  friend bool operator==(const HatchOptions&, const HatchOptions&) = default;
};

}  // namespace tenon
