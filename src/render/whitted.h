#pragma once

#include <array>
#include <vector>

#include "render/integrator.h"
#include "render/light_angles.h"
#include "render/lit_scene.h"
#include "render/straight_light.h"
#include "tenon/accel/accelerator.h"
#include "tenon/math/color.h"

namespace tenon {

/// Where the tree of rays ends.
struct RecursionLimits {
  int depth = 1;         ///< levels of the tree; 1: primary rays and their shadow rays
  double threshold = 0;  ///< a ray is not traced when its share of the pixel (the cumulative product) is no larger
};

/// The complete illumination model of Bouatouch's course:
///
///   I = kd C Ia  +  kd C Σ Ij cos(Lj, N)  +  ks Σ Ij cos(N, Hj)^n  +  ks I(reflected ray)  +  kt I(refracted ray)
///
/// Of what came after the course it shows what the formula has a place for: lights with extent stand in their middle,
/// dielectrics share ks and kt by Fresnel, roughness is not seen, media attenuate.
///
/// Nothing in it is drawn at random.
///
/// The trees of a call grow in waves. In each wave every tree that is not done has the one ray traced that would come
/// next if it were followed alone; the structure is asked for the rays of a wave in one call, and for their shadow rays
/// in others. So the order in which a tree's light is added up does not depend on its neighbours, and no more rays wait
/// than trees times levels.
class WhittedIntegrator final : public Integrator {
 public:
  WhittedIntegrator(const LitScene& scene, const Accelerator& accelerator, const RecursionLimits& limits)
      : scene_(scene), accelerator_(accelerator), limits_(limits), straight_light_(scene, accelerator) {}

  void radiance(std::span<const RayQuery> primary, std::span<const Hit> hits, std::span<const SampleId> samples,
                std::span<Rgb> light, TraceContext& context) override;

 private:
  // A ray still to be traced.
  struct Pending {
    Ray ray;
    RayKind kind;
    int level;
    Rgb weight;
    Hit from;
  };
  // A ray of the wave: the node of a tree where it ends.
  struct Node {
    std::uint32_t tree;
    int level;
    Rgb weight;
    const Reflectance* surface = nullptr;  // where it lies on one
    Vec3 normal;                           // against the ray
    Rgb diffuse;                           // kd C
    Rgb local;                             // what surface and lights send back along it
  };
  // Nodes that lie on a surface.
  struct SurfaceBlock {
    std::array<std::uint32_t, block_size> nodes;
    Vec3Block point, normal, direction;
  };
  struct ShadowRay {
    std::uint32_t node = 0;
    double incidence = 0, highlight = 0;  // as LightAngles
    Rgb incident;
  };

  void shade(std::span<const RayQuery> rays, std::span<const Hit> hits, std::span<Rgb> light);
  void add_surface(std::uint32_t node, const Ray& ray, const Hit& hit);
  void connect(std::span<const Hit> hits, TraceContext& context);
  void connect_through(std::span<const RayQuery> queries, std::span<const Hit> hits, TraceContext& context);
  void aim_at_light(const LitLight& light, const SurfaceBlock& block, std::size_t count, std::span<const Hit> hits);
  Rgb sent_back(const ShadowRay& ray) const;
  double transmitted(const Hit& boundary, const Vec3& direction) const;
  void branch(const Ray& ray, const Hit& hit, const Node& node);
  void push(const Hit& from, const Vec3& direction, RayKind kind, const Rgb& weight, const Node& node);
  bool next_wave();

  const LitScene& scene_;
  const Accelerator& accelerator_;
  RecursionLimits limits_;

  std::vector<std::vector<Pending>> pending_;  // by tree, the next one last
  std::vector<Node> nodes_;                    // of the wave
  std::vector<RayQuery> queries_;
  std::vector<Hit> from_, hits_;
  std::size_t surface_count_ = 0;       // of the wave's nodes that lie on a surface
  std::vector<SurfaceBlock> surfaces_;  // of those, and as many more as there once were
  IncidentLightBlock incident_;         // from a block of surfaces to a light
  LightAngles angles_;
  // The first shadow_count_ of these are rays; the others are there to be overwritten.
  std::size_t shadow_count_ = 0;
  std::vector<RayQuery> shadow_queries_;
  std::vector<ShadowRay> shadow_rays_;
  std::vector<std::uint8_t> occluded_;
  StraightLight straight_light_;
};

}  // namespace tenon
