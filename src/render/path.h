#pragma once

#include <vector>

#include "render/integrator.h"
#include "render/lit_scene.h"

namespace tenon {

/// Path tracing (Kajiya, "The Rendering Equation", 1986) with next-event estimation: at each surface one light is drawn
/// and asked for what it sends there, and the path goes on in a drawn direction. Paths end by Russian roulette, without
/// bias, or at `depth` surfaces.
///
/// The paths of a call are followed together: one call of the structure for the next surfaces of all of them, one for
/// their shadow rays.
class PathIntegrator final : public Integrator {
 public:
  /// @param depth  surfaces along a path that send light to it; 1: light that comes straight from lights
  PathIntegrator(const LitScene& scene, const Accelerator& accelerator, const Sampler& sampler, int depth)
      : scene_(scene), accelerator_(accelerator), sampler_(sampler), depth_(depth) {}

  void radiance(std::span<const RayQuery> primary, std::span<const Hit> hits, std::span<const SampleId> samples,
                std::span<Rgb> light, TraceContext& context) override;

 private:
  struct Path {
    Rgb throughput{1, 1, 1};
    std::uint32_t slot = 0;  // into the spans of radiance()
  };
  struct ShadowRay {
    Rgb light;
    std::uint32_t slot = 0;
  };

  void shade(const Path& path, const RayQuery& query, const Hit& hit, const SampleId& sample, int bounce, Rgb& light);
  void connect(const Path& path, const Hit& hit, const Vec3& normal, const Rgb& albedo, double choice);
  void trace_shadow_rays(std::span<Rgb> light, TraceContext& context);

  const LitScene& scene_;
  const Accelerator& accelerator_;
  Sampler sampler_;
  int depth_;

  std::vector<Path> paths_, next_paths_;
  std::vector<RayQuery> queries_, next_queries_;
  std::vector<Hit> hits_, next_hits_;
  std::vector<RayQuery> shadow_queries_;
  std::vector<ShadowRay> shadow_rays_;
  std::vector<RayBoundary> occluders_;
};

}  // namespace tenon
