#pragma once

#include <array>
#include <utility>
#include <vector>

#include "render/frame_block.h"
#include "render/integrator.h"
#include "render/lit_scene.h"
#include "render/straight_light.h"
#include "render/vertex_groups.h"

namespace tenon {

/// Which of two ways to find light with extent counts: drawing a place of the light, or a direction of the surface's
/// BSDF. Each alone gives the same picture in the end, and is noisy where the other is not.
enum class LightStrategy {
  both,    ///< weighted by the power heuristic (Veach 1997, §9.2)
  lights,  ///< where light is spread, it is found by lights alone
  bsdf,    ///< lights without extent are still asked
};

/// Path tracing (Kajiya, "The Rendering Equation", 1986) with next-event estimation: at each surface one light is drawn
/// and asked for what it sends there, and the path goes on in a drawn direction. Paths end by Russian roulette, without
/// bias, or at `depth` surfaces.
///
/// The paths of a call are followed together: one call of the structure for the next surfaces of all of them, one for
/// their shadow rays to each light.
///
/// Light that a light without extent sends through glass that bends it is not found: no path can be drawn that way.
class PathIntegrator final : public Integrator {
 public:
  /// @param depth  surfaces along a path that send light to it; 1: light that comes straight from lights
  PathIntegrator(const LitScene& scene, const Accelerator& accelerator, const Sampler& sampler, int depth,
                 LightStrategy strategy = LightStrategy::both);

  void radiance(std::span<const RayQuery> primary, std::span<const Hit> hits, std::span<const SampleId> samples,
                std::span<Rgb> light, TraceContext& context) override;
  CutPaths take_cut_paths() override { return std::exchange(cut_, {}); }

 private:
  struct Path {
    Rgb throughput{1, 1, 1};
    double growth = 1;       // of radiance by refraction, which is no reason for a path to end or go on
    Vec3 vertex;             // where light was spread last
    double density = 0;      // of the direction taken there; 0: it was the only one
    std::uint32_t slot = 0;  // into the spans of radiance()
    bool is_camera_ray = true;
    bool is_sharp = true;  // nothing has spread it
  };
  struct ShadowRay {
    Rgb light;
    std::uint32_t slot = 0;
    MediumId medium = medium_outside;
  };
  /// Those to one light: neighbours that go to one place are traced together.
  struct ShadowRays {
    std::vector<RayQuery> queries;
    std::vector<ShadowRay> rays;
  };
  /// A light that was drawn at a vertex; null: none sends light there.
  struct DrawnLight {
    const LitLight* light;
    double probability;
    LightSample sample;
  };
  /// What is drawn for the vertices of one bounce, each as long as vertices_, or empty where nothing asks for it.
  struct Draws {
    std::vector<Sample2> choice, light_place, direction, roulette;
  };
  /// Vertices of one group, and what becomes of them.
  struct Block {
    std::span<const std::uint32_t> vertices;
    Vec3Block normal, direction;  // of the rays that met them
    RgbBlock color;
    FrameBlock frames;
    Vec3Block wo;
    std::array<DrawnLight, block_size> lights;
    Vec3Block to_light, wi;
    BsdfValues to_viewer;  // of the light from there
    NumberBlock choice;
    Sample2Block place;
    BsdfSamples samples;
    Vec3Block next_direction;
  };

  void note_light(int bounce, std::span<const Rgb> light);
  bool meet(Path& path, const RayQuery& query, const Hit& hit, Rgb& light) const;
  void draw(std::span<const SampleId> samples, int bounce);
  void scatter(std::span<const std::uint32_t> vertices, std::span<const RayQuery> rays, std::span<const Hit> hits,
               int bounce);
  void draw_light(std::size_t i, const Hit& hit);
  void connect(std::size_t i, const Hit& hit);
  void go_on(std::size_t i, const Hit& hit, int bounce);
  double weight(double density, double other) const;
  double weight_of_met_light(const Path& path, const LitLight& light, double density) const;
  void trace_shadow_rays(std::span<Rgb> light, TraceContext& context);

  const LitScene& scene_;
  const Accelerator& accelerator_;
  Sampler sampler_;
  int depth_;
  LightStrategy strategy_;

  std::vector<Path> paths_, next_paths_;
  std::vector<RayQuery> queries_, next_queries_;
  std::vector<Hit> hits_, next_hits_;
  std::vector<std::uint32_t> vertices_;  // surfaces that may send light on along a path, which is in paths_
  std::vector<SampleId> samples_;        // of the vertices
  Draws draws_;
  VertexGroups groups_;
  Block block_;
  Bsdf bsdf_;
  std::vector<ShadowRays> shadow_rays_;  // by light
  std::vector<std::uint8_t> occluded_;
  StraightLight straight_light_;
  CutPaths cut_;
  double noted_light_ = 0;  // of all rays of a call, after a bounce
};

}  // namespace tenon
