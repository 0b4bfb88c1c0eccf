#pragma once

#include <cstdint>
#include <limits>

#include "tenon/base/id.h"
#include "tenon/base/inline_vector.h"
#include "tenon/csg/scene_graph.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// A primitive of the scene, placed and with its attributes; numbered in tree order.
using LeafId = Id<struct Leaf_>;

/// What fills a region of space: outside everything, any opaque solid, or one transparent material.
using MediumId = std::uint32_t;
inline constexpr MediumId medium_outside = 0;
inline constexpr MediumId medium_opaque = 1;

/// A face of a placed primitive.
struct LeafFace {
  LeafId leaf;
  std::uint32_t face = 0;

  friend constexpr bool operator==(const LeafFace&, const LeafFace&) = default;
};

/// The boundary of the solid met by a ray.
struct Hit {
  double t = std::numeric_limits<double>::infinity();
  double bound = 0;                  ///< on the error of t: of the same t, structures may know different ones
  Vec3 point;                        ///< ray.at(t)
  Vec3 normal;                       ///< length 1, pointing out of the solid; of a surface: its own
  LeafFace surface;                  ///< the primitive that shows, and its face
  MaterialId material;               ///< none: the scene's default material
  bool entering = false;             ///< the ray enters the solid (or another medium of it)
  bool is_surface = false;           ///< met a surface that has no inside
  MediumId before = medium_outside;  ///< the medium on the ray's side
  MediumId after = medium_outside;   ///< the medium behind
  /// Every face that coincides here: a ray that starts at this hit leaves exactly these.
  InlineVector<LeafFace, 4> faces;

  bool found() const { return t < std::numeric_limits<double>::infinity(); }
  /// Makes it one that was not found; what else was known stays there, and means nothing.
  void lose() { t = std::numeric_limits<double>::infinity(); }
};

/// A stretch of a ray inside the solid; ends may be infinite.
struct SolidSpan {
  double t_in = 0;
  double t_out = 0;

  friend constexpr bool operator==(const SolidSpan&, const SolidSpan&) = default;
};

}  // namespace tenon
