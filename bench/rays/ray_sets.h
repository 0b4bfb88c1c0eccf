#pragma once

#include <string_view>
#include <vector>

#include "rays/bench_scene.h"
#include "tenon/accel/accelerator.h"

namespace tenon::bench {

/// Stored rays of one kind, the same for every contender. Shadow rays ask whether anything is met before t_max.
struct RaySet {
  RayKind kind = RayKind::primary;
  std::vector<RayQuery> rays;

  std::string_view name() const { return ray_kind_names[static_cast<std::size_t>(kind)]; }
};

/// The place of the i-th primary ray in the picture: tiles of 16 x 16, and within a tile along the Z-order curve, so
/// that any 8 or 16 rays in a row are a block of pixels.
struct PixelPlace {
  int x = 0, y = 0;
};
PixelPlace pixel_place(std::size_t i);

/// Of primary, shadow and diffuse rays.
inline constexpr std::size_t ray_sets_of_a_scene = 3;

/// Primary rays through the pixels' centres; from what they hit, a shadow ray to each light, tile by tile; and from
/// each hit one ray in a random direction, cosine-distributed around the normal. The same on every machine.
/// @param lift  rays from a hit start this far above it, so that a mesh, which lies as far as its error from the
///              exact surface, does not stop them where they start
/// @return primary, shadow, diffuse
std::vector<RaySet> make_ray_sets(const BenchScene& scene, const Accelerator& accelerator, double lift);

/// A lift for rays that only Tenon traces: small against the scene, and far above rounding.
double small_lift(const BenchScene& scene);

}  // namespace tenon::bench
