#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/quarter_turns.h"
#include "render/sampler.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// The isotropic GGX distribution of microfacets with Smith's masking and shadowing (Walter et al. 2007; Heitz 2014).
/// Directions are local: z is the surface's normal. `wo`, where the light goes, has z > 0.
class Microfacets {
 public:
  /// @param alpha  GGX's width, above 0
  explicit Microfacets(double alpha) : alpha_(alpha) {}

  /// D(h / |h|), the same for h and -h.
  /// @param squared  |h|²
  double density(const Vec3& h, double squared) const {
    const double a2 = alpha_ * alpha_;
    const double t = (h.x * h.x + h.y * h.y) + a2 * (h.z * h.z);
    return a2 * (squared * squared) / (std::numbers::pi * (t * t));
  }

  /// Smith's Lambda; infinite along the surface.
  double lambda(const Vec3& v) const {
    return 0.5 * (std::sqrt(1 + alpha_ * alpha_ * (v.x * v.x + v.y * v.y) / (v.z * v.z)) - 1);
  }
  /// The share of the microfacets that are seen unmasked from where lambda() is that.
  static double masking(double lambda_o) { return 1 / (1 + lambda_o); }
  /// Masking and shadowing together, correlated by height.
  static double masking_shadowing(double lambda_o, double lambda_i) { return 1 / (1 + lambda_o + lambda_i); }

  /// A microfacet's normal, drawn among those that wo sees (Dupuy and Benyoub, "Sampling Visible GGX Normals with
  /// Spherical Caps", 2023).
  Vec3 sample_visible(const Vec3& wo, const Sample2& sample) const {
    const Vec3 stretched = unit({alpha_ * wo.x, alpha_ * wo.y, wo.z});
    const SineCosine phi = quarter_turn_sine_cosine(4 * sample.u);
    const double z = (1 - sample.v) * (1 + stretched.z) - stretched.z;
    const double radius = std::sqrt(std::max(0.0, 1 - z * z));
    const Vec3 h = Vec3{radius * phi.cosine, radius * phi.sine, z} + stretched;
    return unit({alpha_ * h.x, alpha_ * h.y, std::max(0.0, h.z)});
  }

 private:
  // As normalize(), for what is no longer than 2 and not so short that its square vanishes.
  static Vec3 unit(const Vec3& v) { return v * (1 / length(v)); }

  double alpha_;
};

}  // namespace tenon
