#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "render/integrator.h"
#include "render/lit_scene.h"
#include "render/sampler.h"
#include "render/section_hatch.h"
#include "render/surface_features.h"
#include "tenon/accel/accelerator.h"
#include "tenon/film/film.h"
#include "tenon/render/camera_rays.h"
#include "tenon/render/renderer.h"

namespace tenon {

/// What one thread needs to take samples. Primary rays go to the accelerator one sample of a whole tile at a time.
class TileWorker {
 public:
  /// @param features  null: the film has no layers of surfaces
  /// @param hatch     null: cut faces have no lines
  TileWorker(const LitScene& scene, const SurfaceFeatures* features, const SectionHatch* hatch,
             const Accelerator& accelerator, const CameraRays& camera, const RenderOptions& options);

  /// Adds the samples [first, end) of a tile's pixels to a film.
  /// @return what the limit of the depth cut off of them
  CutPaths take(const PixelWindow& tile, std::uint32_t first, std::uint32_t end, Film& film);

  const TraversalStatistics& statistics() const { return context_->statistics; }

 private:
  void aim(const PixelWindow& tile, std::uint32_t index);
  void aim_from_eye();
  void add(std::size_t i, Film& film);
  void look_through(const RayQuery& query, FilmSample& sample);

  const SurfaceFeatures* features_;
  const SectionHatch* hatch_;
  const Accelerator& accelerator_;
  const CameraRays& camera_;
  std::uint32_t samples_;
  Sampler sampler_;
  bool is_random_, transparent_, wants_spans_;
  std::unique_ptr<TraceContext> context_, span_context_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<SampleId> ids_;
  std::vector<Sample2> in_pixel_, on_lens_;
  std::vector<PicturePlace> places_;
  std::vector<RayQuery> queries_;
  std::vector<Hit> hits_;
  std::vector<Rgb> light_;
  std::vector<SolidSpan> spans_;
};

}  // namespace tenon
