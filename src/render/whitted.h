#pragma once

#include <vector>

#include "render/integrator.h"
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
class WhittedIntegrator final : public Integrator {
 public:
  WhittedIntegrator(const LitScene& scene, const Accelerator& accelerator, const RecursionLimits& limits)
      : scene_(scene), accelerator_(accelerator), limits_(limits) {}

  void radiance(std::span<const RayQuery> primary, std::span<const Hit> hits, std::span<const SampleId> samples,
                std::span<Rgb> light, TraceContext& context) override;

  /// The light that comes back along a ray of length 1.
  /// @param ray      the ray
  /// @param hit      what it meets first; not found: the background
  /// @param context  of this thread
  Rgb radiance(const Ray& ray, const Hit& hit, TraceContext& context);

 private:
  // A ray still to be traced. The sum over the tree of rays is taken path by path, each weighted with its cumulative
  // product ("How to stop tracing rays?"), so no depth of the tree needs a deep call stack.
  struct Pending {
    Ray ray;
    RayKind kind;
    int level;
    Rgb weight;
    Hit from;
  };

  Rgb local_light(const Ray& ray, const Hit& hit, const Vec3& normal, TraceContext& context);
  Rgb transmittance(const Hit& hit, const LitLight& light, const IncidentLight& incident, TraceContext& context);
  double transmitted(const Hit& boundary, const Vec3& direction) const;
  void branch(const Ray& ray, const Hit& hit, const Vec3& normal, const Rgb& weight, int level);
  void push(const Hit& from, const Vec3& direction, RayKind kind, const Rgb& weight, int level);

  const LitScene& scene_;
  const Accelerator& accelerator_;
  RecursionLimits limits_;
  std::vector<Pending> pending_;
  PassedBoundaries passed_;
};

}  // namespace tenon
