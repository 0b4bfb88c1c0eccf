// What the lobes of a BSDF send on from given directions. Included once for each instruction set, for the compiler to
// make vectors of.

#if defined(TENON_RENDER_LOBE_VALUES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_RENDER_LOBE_VALUES_INL_H_
#undef TENON_RENDER_LOBE_VALUES_INL_H_
#else
#define TENON_RENDER_LOBE_VALUES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "render/bsdf.h"
#include "render/microfacet.h"
#include "render/optics.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

inline void AddDiffuse(const Lobe& lobe, const Vec3Block& wi, std::size_t size, BsdfValues& HWY_RESTRICT sum) {
  for (std::size_t i = 0; i < size; ++i) {
    const bool counts = wi.z[i] > 0 && lobe.importance[i] > 0;
    const double density = counts ? wi.z[i] * std::numbers::inv_pi : 0;
    sum.light.r[i] += density * lobe.weight.r[i];
    sum.light.g[i] += density * lobe.weight.g[i];
    sum.light.b[i] += density * lobe.weight.b[i];
    sum.density[i] += density * lobe.importance[i];
  }
}

// Walter et al. 2007, equations 20 and 14; in a rough dielectric it is reflection that is drawn with Fresnel's share.
// @param reflected  what microfacets reflect, by point and cosine
template <bool is_drawn_by_fresnel, class Reflected>
HWY_INLINE void AddReflection(const Lobe& lobe, const Vec3Block& wo_block, const Vec3Block& wi_block, std::size_t size,
                              const Reflected& reflected, BsdfValues& HWY_RESTRICT sum) {
  const Microfacets facets(lobe.alpha);
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 wo = wo_block[i], wi = wi_block[i];
    const Vec3 h = wo + wi;
    const double squared = dot(h, h);
    const double spread = facets.density(h, squared) / (4 * wo.z);
    // The microfacet halves the angle between directions of length 1: its cosine is half of their sum's length.
    const Rgb fresnel = reflected(i, 0.5 * std::sqrt(squared));
    const bool counts = wi.z > 0 && lobe.importance[i] > 0;
    const double drawn = counts ? Microfacets::masking(lobe.lambda[i]) * spread : 0;
    const double kept = counts ? Microfacets::masking_shadowing(lobe.lambda[i], facets.lambda(wi)) * spread : 0;
    sum.light.r[i] += kept * (lobe.weight.r[i] * fresnel.r);
    sum.light.g[i] += kept * (lobe.weight.g[i] * fresnel.g);
    sum.light.b[i] += kept * (lobe.weight.b[i] * fresnel.b);
    sum.density[i] += lobe.importance[i] * drawn * (is_drawn_by_fresnel ? fresnel.r : 1);
  }
}

inline void AddConductor(const Lobe& lobe, const Vec3Block& wo, const Vec3Block& wi, std::size_t size,
                         BsdfValues& HWY_RESTRICT sum) {
  const auto by_schlick = [&lobe](std::size_t i, double cos) -> Rgb {
    const Rgb f0 = lobe.color[i];
    return {fresnel_schlick(cos, f0.r), fresnel_schlick(cos, f0.g), fresnel_schlick(cos, f0.b)};
  };
  AddReflection<false>(lobe, wo, wi, size, by_schlick, sum);
}

template <bool is_drawn_by_fresnel>
HWY_INLINE void AddDielectric(const Lobe& lobe, const Vec3Block& wo, const Vec3Block& wi, std::size_t size,
                              BsdfValues& HWY_RESTRICT sum) {
  const auto by_fresnel = [eta = lobe.eta](std::size_t, double cos) -> Rgb {
    const double f = fresnel_dielectric(cos, eta);
    return {f, f, f};
  };
  AddReflection<is_drawn_by_fresnel>(lobe, wo, wi, size, by_fresnel, sum);
}

// Walter et al. 2007, equations 21 and 17, with the indices divided by that behind the surface.
inline void AddRefractionAt(const Lobe& lobe, const Vec3& wo, const Vec3& wi, std::size_t i, BsdfValues& sum) {
  const Vec3 h = lobe.eta * wo + wi;
  const double squared = dot(h, h);
  const Vec3 m = h / (h.z < 0 ? -std::sqrt(squared) : std::sqrt(squared));
  const double cos_o = dot(wo, m), cos_i = dot(wi, m);
  if (!(cos_o > 0) || !(cos_i < 0)) return;
  const double share = 1 - fresnel_dielectric(cos_o, lobe.eta);
  const double bend = lobe.eta * cos_o + cos_i;
  const Microfacets facets(lobe.alpha);
  const double spread = share * cos_o * facets.density(h, squared) / wo.z * (-cos_i / (bend * bend));
  const double kept = Microfacets::masking_shadowing(lobe.lambda[i], facets.lambda(wi)) * spread;
  sum.light.set(i, sum.light[i] + (kept * lobe.eta * lobe.eta) * (lobe.weight[i] * lobe.color[i]));
  sum.density[i] += lobe.importance[i] * Microfacets::masking(lobe.lambda[i]) * spread;
}

inline void AddRefraction(const Lobe& lobe, const Vec3Block& wo, const Vec3Block& wi, std::size_t size,
                          BsdfValues& HWY_RESTRICT sum) {
  for (std::size_t i = 0; i < size; ++i) {
    if (wi.z[i] < 0 && lobe.importance[i] > 0) AddRefractionAt(lobe, wo[i], wi[i], i, sum);
  }
}

inline void Evaluate(std::span<const Lobe> lobes, const NumberBlock& total, const Vec3Block& wo, const Vec3Block& wi,
                     std::size_t size, BsdfValues& HWY_RESTRICT sum) {
  for (NumberBlock* numbers : {&sum.light.r, &sum.light.g, &sum.light.b, &sum.density}) {
    std::fill_n(numbers->begin(), size, 0.0);
  }
  for (const Lobe& lobe : lobes) {
    switch (lobe.kind) {
      case Lobe::Kind::diffuse:
        AddDiffuse(lobe, wi, size, sum);
        break;
      case Lobe::Kind::conductor:
        AddConductor(lobe, wo, wi, size, sum);
        break;
      case Lobe::Kind::gloss:
        AddDielectric<false>(lobe, wo, wi, size, sum);
        break;
      case Lobe::Kind::rough_dielectric:
        AddDielectric<true>(lobe, wo, wi, size, sum);
        AddRefraction(lobe, wo, wi, size, sum);
        break;
      case Lobe::Kind::mirror:
      case Lobe::Kind::refraction:
      case Lobe::Kind::dielectric:
        break;
    }
  }
  for (std::size_t i = 0; i < size; ++i) sum.density[i] = total[i] > 0 ? sum.density[i] / total[i] : 0;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#endif
