#pragma once

#include <cstdint>
#include <vector>

namespace tenon {

/// A boundary met by a ray. The exact crossing of the boundary, as the scene describes it, lies within `bound` of `t`;
/// `bound` includes the rounding of the affine map, of the ray and of the root, and the scene's Tolerance.
struct Crossing {
  double t = 0;            ///< parameter on the ray; may be -inf or +inf for unbounded solids
  double bound = 0;        ///< error bound on t, >= 0
  std::uint32_t face = 0;  ///< which of the primitive's faces; its meaning is the primitive's own
  bool entering = false;   ///< from outside to inside along the ray; false for surfaces
  bool surface = false;    ///< met a surface that has no inside: a probe, never a flip
};

/// The sorted crossings of one primitive along a ray. For a solid their number is even, they alternate between entering
/// and leaving, and the first one enters.
using Spans = std::vector<Crossing>;

}  // namespace tenon
