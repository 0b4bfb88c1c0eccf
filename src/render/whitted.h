#pragma once

#include <array>
#include <vector>

#include "render/integrator.h"
#include "render/light_angles.h"
#include "render/lit_scene.h"
#include "render/passed_boundaries.h"
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
/// next if it were followed alone; the structure is asked for the rays of a wave in one call, and in another for their
/// shadow rays, as long as nothing in the scene lets light through. So the order in which a tree's light is added up
/// does not depend on its neighbours, and no more rays wait than trees times levels.
class WhittedIntegrator final : public Integrator {
 public:
  WhittedIntegrator(const LitScene& scene, const Accelerator& accelerator, const RecursionLimits& limits)
      : scene_(scene), accelerator_(accelerator), limits_(limits) {}

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
    Vec3 normal;  // against the ray
    Rgb diffuse;  // kd C
    Rgb local;    // what surface and lights send back along it
  };
  struct ShadowRay {
    std::uint32_t node = 0;
    Rgb incident;
  };
  // Shadow rays that bring light.
  struct LitBlock {
    std::size_t count = 0;
    std::array<std::uint32_t, block_size> rays;  // into shadow_rays_
    Vec3Block normal, to_light, direction;
    LightAngles angles;
  };

  void shade(std::span<const RayQuery> rays, std::span<const Hit> hits, std::span<Rgb> light);
  void connect(std::span<const RayQuery> rays, std::span<const Hit> hits, TraceContext& context);
  void add_lit(std::span<const Hit> hits);
  void find_shares(std::span<const Hit> hits, TraceContext& context);
  Rgb transmittance(const RayQuery& query, const Hit& hit, TraceContext& context);
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
  std::vector<std::uint32_t> surfaces_;  // the nodes that lie on one
  std::vector<RayQuery> shadow_queries_;
  std::vector<ShadowRay> shadow_rays_;
  std::vector<Rgb> shares_;
  LitBlock lit_;
  std::vector<std::uint8_t> occluded_;
  PassedBoundaries passed_;
};

}  // namespace tenon
