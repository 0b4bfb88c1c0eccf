#pragma once

#include "render/albedo_table.h"
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

  /// How it scatters light that leaves along wo, at each point of a block.
  /// @param wo        local: z is the normal on the viewer's side; outlives what is done with the BSDF
  /// @param color     of the material at these points, linear
  /// @param boundary  of all of them
  /// @param count     of points
  void scatter(const Vec3Block& wo, const RgbBlock& color, const Boundary& boundary, std::size_t count,
               Bsdf& bsdf) const;

  /// The share of light that goes straight on through the boundary, as if there were none; 0 where it is bent.
  Rgb unbent(const Rgb& color, const Boundary& boundary) const;

 private:
  struct Points;
  void add_lobes(const Points& at, const Boundary& boundary, Bsdf& bsdf) const;
  void add_dielectric(const Points& at, const NumberBlock& share, const Boundary& boundary, Bsdf& bsdf) const;
  void add_principled(const Points& at, const Boundary& boundary, Bsdf& bsdf) const;
  void find_albedo(ScatteredPart part, const Points& at, double alpha, double eta, NumberBlock& albedo) const;

  MaterialModel model_;
  double kd_, ks_, kt_;
  double alpha_;
  double metallic_, transmission_;
  double coat_, coat_alpha_;
  double ior_;
  AlbedoTables& tables_;
};

}  // namespace tenon
