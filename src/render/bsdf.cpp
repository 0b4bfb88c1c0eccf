#include "render/bsdf.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <span>

#include "render/microfacet.h"
#include "render/optics.h"
#include "render/sphere_sampling.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/bsdf.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "render/lobe_values-inl.h"

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

// Reflection or refraction at a smooth surface.
// @param total   of the importances of all lobes
// @param choice  between the two
inline void set_sharp(const Lobe& lobe, double total, const Vec3& wo, double choice, std::size_t i,
                      BsdfSamples& samples) {
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
