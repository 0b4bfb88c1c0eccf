#pragma once

#include "render/bsdf.h"
#include "tenon/csg/hit.h"
#include "tenon/scene/material.h"

namespace tenon {

/// What a ray meets at a surface, beside the surface itself.
struct Boundary {
  double ior_before = 1, ior_behind = 1;
  bool is_opaque_behind = false;  ///< an opaque solid takes what the surface lets through
};

/// A material as path tracing uses it.
class Surface {
 public:
  /// @param tables  outlive the surface
  Surface(const Material& material, AlbedoTables& tables);

  /// How it scatters light that leaves along wo.
  /// @param wo     local: z is the normal on the viewer's side
  /// @param color  of the material at this point, linear
  Bsdf bsdf(const Vec3& wo, const Rgb& color, const Boundary& boundary) const;

  /// The share of light that goes straight on through the boundary, as if there were none; 0 where it is bent.
  Rgb unbent(const Rgb& color, const Boundary& boundary) const;

 private:
  void add_dielectric(Bsdf& bsdf, double cos, const Rgb& tint, double share, const Boundary& boundary) const;
  void add_gloss(Bsdf& bsdf, double cos, double alpha, double eta, double share, double albedo) const;
  double reflected_by_dielectric(double cos, double alpha, double eta) const;
  void add_principled(Bsdf& bsdf, double cos, const Rgb& color, const Boundary& boundary) const;

  MaterialModel model_;
  double kd_, ks_, kt_;
  double alpha_;
  double metallic_, transmission_;
  double coat_, coat_alpha_;
  double ior_;
  AlbedoTables& tables_;
  const AlbedoTable* conductor_ = nullptr;  // of alpha_
};

}  // namespace tenon
