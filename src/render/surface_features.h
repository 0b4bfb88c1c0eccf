#pragma once

#include <cstdint>
#include <vector>

#include "render/lit_scene.h"
#include "tenon/csg/hit.h"
#include "tenon/film/film.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// What the layers of a picture say of the surfaces of a scene.
class SurfaceFeatures {
 public:
  SurfaceFeatures(const Scene& scene, const LitScene& lit);

  /// Fills in depth, normal, point, albedo and ids of what a ray met.
  void describe(const Hit& hit, FilmSample& sample) const;

 private:
  const LitScene& lit_;
  std::vector<std::uint32_t> solid_of_leaf_;
  std::uint32_t default_material_;
};

}  // namespace tenon
