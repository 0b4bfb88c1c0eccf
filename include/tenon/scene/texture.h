#pragma once

#include "tenon/math/affine3.h"
#include "tenon/math/color.h"

namespace tenon {

enum class TextureKind {
  none,
  checker,  ///< cubes of two colours in turn
  marble,   ///< veins across x, bent by turbulence
  wood,     ///< rings around z, bent by turbulence
  noise,    ///< clouds between the two colours
};

/// A pattern that fills space: a cut shows what the solid has inside.
struct SolidTexture {
  TextureKind kind = TextureKind::none;
  Rgba second{0.1, 0.1, 0.1, 1};  ///< beside the material's colour
  double size = 1;                ///< of a cube, from vein to vein, from ring to ring; in the texture's units
  double turbulence = 1;          ///< how far veins and rings are bent, in sizes
  Affine3 texture_from_world;     ///< the pattern stands where its material was named, and moves with it

  friend bool operator==(const SolidTexture&, const SolidTexture&) = default;
};

}  // namespace tenon
