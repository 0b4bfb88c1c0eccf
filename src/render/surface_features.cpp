#include "render/surface_features.h"

#include "scene/solid_numbers.h"

namespace tenon {

SurfaceFeatures::SurfaceFeatures(const Scene& scene, const LitScene& lit)
    : lit_(lit),
      solid_of_leaf_(solid_numbers(*scene.tree, static_cast<bool>(scene.first_section_plane))),
      default_material_(static_cast<std::uint32_t>(scene.materials.size())) {}

void SurfaceFeatures::describe(const Hit& hit, FilmSample& sample) const {
  if (!hit.found()) return;
  const std::uint32_t leaf = hit.surface.leaf.get();
  sample.depth = hit.t;
  sample.normal = hit.normal;
  sample.point = hit.point;
  sample.albedo = lit_.albedo(hit);
  sample.ids = {leaf + 1, (hit.material ? hit.material.get() : default_material_) + 1, solid_of_leaf_[leaf] + 1};
}

}  // namespace tenon
