#include "render/bsdf.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <span>

#include "render/microfacet.h"
#include "render/optics.h"
#include "render/sphere_sampling.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/bsdf.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TENON_RENDER_BSDF_CPP_
#define TENON_RENDER_BSDF_CPP_
namespace tenon {
namespace {

inline bool is_rough(Lobe::Kind kind) {
  return kind == Lobe::Kind::conductor || kind == Lobe::Kind::gloss || kind == Lobe::Kind::rough_dielectric;
}

inline bool is_spread(Lobe::Kind kind) {
  return kind == Lobe::Kind::diffuse || is_rough(kind);
}

/// What a sample is made of: the lobe that is chosen, and what is left of the choice, which is as good as a new one.
struct LobeChoices {
  NumberBlock lobe, rest;
};

// Walter et al. 2007, equations 21 and 17, with the indices divided by that behind the surface.
inline void add_refraction(const Lobe& lobe, const Vec3& wo, const Vec3& wi, std::size_t i,
                           BsdfValues& HWY_RESTRICT sum) {
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

// Reflection or refraction at a smooth surface.
// @param total   of the importances of all lobes
// @param choice  between the two
inline void set_sharp(const Lobe& lobe, double total, const Vec3& wo, double choice, std::size_t i,
                      BsdfSamples& HWY_RESTRICT samples) {
  const Rgb weight = (total / lobe.importance[i]) * lobe.weight[i];
  samples.density[i] = 0;
  samples.weight.set(i, weight);
  samples.direction.set(i, {-wo.x, -wo.y, wo.z});
  if (lobe.kind == Lobe::Kind::mirror) return;
  const bool by_fresnel = lobe.kind == Lobe::Kind::dielectric;
  if (by_fresnel && choice < fresnel_dielectric(wo.z, lobe.eta)) return;
  const auto refracted = refract(-wo, {0, 0, 1}, lobe.eta);
  if (!refracted) return;
  samples.direction.set(i, *refracted);
  samples.is_unbent[i] = lobe.is_window && lobe.eta == 1;
  if (by_fresnel) samples.weight.set(i, lobe.eta * lobe.eta * (weight * lobe.color[i]));
}

}  // namespace
}  // namespace tenon
#endif

// What follows is compiled for each instruction set, for the compiler to make vectors of.
HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

void FindLambda(const Vec3Block& wo, std::size_t size, Lobe& HWY_RESTRICT lobe) {
  const Microfacets facets(lobe.alpha);
  for (std::size_t i = 0; i < size; ++i) lobe.lambda[i] = facets.lambda(wo[i]);
}

void AddDiffuse(const Lobe& lobe, const Vec3Block& wi, std::size_t size, BsdfValues& HWY_RESTRICT sum) {
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

void AddConductor(const Lobe& lobe, const Vec3Block& wo, const Vec3Block& wi, std::size_t size,
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

void AddRefraction(const Lobe& lobe, const Vec3Block& wo, const Vec3Block& wi, std::size_t size,
                   BsdfValues& HWY_RESTRICT sum) {
  for (std::size_t i = 0; i < size; ++i) {
    if (wi.z[i] < 0 && lobe.importance[i] > 0) add_refraction(lobe, wo[i], wi[i], i, sum);
  }
}

void Evaluate(std::span<const Lobe> lobes, const NumberBlock& total, const Vec3Block& wo, const Vec3Block& wi,
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

void ChooseLobes(std::span<const Lobe> lobes, const NumberBlock& total, const NumberBlock& choice, std::size_t size,
                 LobeChoices& HWY_RESTRICT choices) {
  NumberBlock left;  // of the choice, by importance; below 0 once it has fallen on a lobe
  for (std::size_t i = 0; i < size; ++i) {
    left[i] = choice[i] * total[i];
    choices.lobe[i] = -1;
    choices.rest[i] = 0;
  }
  for (std::size_t k = 0; k < lobes.size(); ++k) {
    const NumberBlock& importance = lobes[k].importance;
    const auto number = static_cast<double>(k);
    for (std::size_t i = 0; i < size; ++i) {
      const bool may_be = left[i] >= 0 && importance[i] > 0;
      choices.rest[i] = may_be ? std::min(left[i] / importance[i], 1.0) : choices.rest[i];
      choices.lobe[i] = may_be ? number : choices.lobe[i];
      left[i] -= importance[i];
    }
  }
}

void SampleDiffuse(double number, const LobeChoices& choices, const Sample2Block& place, std::size_t size,
                   Vec3Block& HWY_RESTRICT direction) {
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 drawn = cosine_hemisphere(place[i]);
    const bool is_chosen = choices.lobe[i] == number;
    direction.x[i] = is_chosen ? drawn.x : direction.x[i];
    direction.y[i] = is_chosen ? drawn.y : direction.y[i];
    direction.z[i] = is_chosen ? drawn.z : direction.z[i];
  }
}

// What a rough surface reflects; lost directions, which would go below it, end with z = 0.
void SampleReflection(double number, double alpha, const LobeChoices& choices, const Vec3Block& wo_block,
                      const Sample2Block& place, std::size_t size, Vec3Block& HWY_RESTRICT direction) {
  const Microfacets facets(alpha);
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 wo = wo_block[i];
    const Vec3 m = facets.sample_visible(wo, place[i]);
    const Vec3 drawn = (2 * dot(wo, m)) * m - wo;
    const bool is_chosen = choices.lobe[i] == number;
    direction.x[i] = is_chosen ? drawn.x : direction.x[i];
    direction.y[i] = is_chosen ? drawn.y : direction.y[i];
    direction.z[i] = is_chosen ? std::max(0.0, drawn.z) : direction.z[i];
  }
}

// What a rough dielectric refracts of what SampleReflection() had reflected. Lost directions end with z = 0.
void SampleRefraction(double number, const Lobe& lobe, const LobeChoices& choices, const Vec3Block& wo_block,
                      const Sample2Block& place, std::size_t size, Vec3Block& HWY_RESTRICT direction) {
  const Microfacets facets(lobe.alpha);
  for (std::size_t i = 0; i < size; ++i) {
    if (choices.lobe[i] != number) continue;
    const Vec3 wo = wo_block[i];
    const Vec3 m = facets.sample_visible(wo, place[i]);
    if (choices.rest[i] < fresnel_dielectric(dot(wo, m), lobe.eta)) continue;
    const auto refracted = refract(-wo, m, lobe.eta);
    direction.set(i, refracted && refracted->z < 0 ? *refracted : Vec3{});
  }
}

void SampleSpread(std::span<const Lobe> lobes, const LobeChoices& choices, const Vec3Block& wo,
                  const Sample2Block& place, std::size_t size, Vec3Block& HWY_RESTRICT direction) {
  for (std::size_t k = 0; k < lobes.size(); ++k) {
    const Lobe& lobe = lobes[k];
    const auto number = static_cast<double>(k);
    if (lobe.kind == Lobe::Kind::diffuse) SampleDiffuse(number, choices, place, size, direction);
    if (is_rough(lobe.kind)) SampleReflection(number, lobe.alpha, choices, wo, place, size, direction);
    if (lobe.kind == Lobe::Kind::rough_dielectric) {
      SampleRefraction(number, lobe, choices, wo, place, size, direction);
    }
  }
}

void Sample(std::span<const Lobe> lobes, const NumberBlock& total, const Vec3Block& wo, const NumberBlock& choice,
            const Sample2Block& place, std::size_t size, BsdfSamples& HWY_RESTRICT samples) {
  LobeChoices choices;
  ChooseLobes(lobes, total, choice, size, choices);
  SampleSpread(lobes, choices, wo, place, size, samples.direction);
  BsdfValues values;
  Evaluate(lobes, total, wo, samples.direction, size, values);
  for (std::size_t i = 0; i < size; ++i) {
    const double weight = values.density[i] > 0 ? 1 / values.density[i] : 0;
    samples.weight.r[i] = weight * values.light.r[i];
    samples.weight.g[i] = weight * values.light.g[i];
    samples.weight.b[i] = weight * values.light.b[i];
    samples.density[i] = values.density[i];
  }
  std::fill_n(samples.is_unbent.begin(), size, std::uint8_t{0});
  for (std::size_t k = 0; k < lobes.size(); ++k) {
    if (is_spread(lobes[k].kind)) continue;
    for (std::size_t i = 0; i < size; ++i) {
      if (choices.lobe[i] == static_cast<double>(k)) set_sharp(lobes[k], total[i], wo[i], choices.rest[i], i, samples);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(FindLambda);
HWY_EXPORT(Evaluate);
HWY_EXPORT(Sample);

void Bsdf::start(const Vec3Block& wo, std::size_t count) {
  wo_ = &wo;
  size_ = whole_vectors(count);
  count_ = 0;
}

Lobe& Bsdf::add(Lobe::Kind kind, double alpha) {
  assert(count_ < most_lobes);
  Lobe& lobe = lobes_[count_++];
  lobe.kind = kind;
  lobe.alpha = alpha;
  lobe.is_window = false;
  return lobe;
}

void Bsdf::complete() {
  spreads_ = false;
  std::fill_n(total_.begin(), size_, 0.0);
  for (Lobe& lobe : std::span(lobes_).first(count_)) {
    spreads_ |= is_spread(lobe.kind);
    if (is_rough(lobe.kind)) HWY_DYNAMIC_DISPATCH(FindLambda)(*wo_, size_, lobe);
    for (std::size_t i = 0; i < size_; ++i) total_[i] += lobe.importance[i];
  }
}

void Bsdf::evaluate(const Vec3Block& wi, BsdfValues& values) const {
  HWY_DYNAMIC_DISPATCH(Evaluate)(std::span(lobes_).first(count_), total_, *wo_, wi, size_, values);
}

void Bsdf::sample(const NumberBlock& choice, const Sample2Block& place, BsdfSamples& samples) const {
  HWY_DYNAMIC_DISPATCH(Sample)(std::span(lobes_).first(count_), total_, *wo_, choice, place, size_, samples);
}

}  // namespace tenon
#endif
