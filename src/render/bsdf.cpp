#include "render/bsdf.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "render/microfacet.h"
#include "render/optics.h"
#include "render/sphere_sampling.h"

namespace tenon {

namespace {

bool is_rough(Lobe::Kind kind) {
  return kind == Lobe::Kind::conductor || kind == Lobe::Kind::gloss || kind == Lobe::Kind::rough_dielectric;
}

bool is_spread(Lobe::Kind kind) {
  return kind == Lobe::Kind::diffuse || is_rough(kind);
}

// What a microfacet reflects.
Rgb reflected_by(const Lobe& lobe, double cos) {
  if (lobe.kind == Lobe::Kind::conductor) {
    return {fresnel_schlick(cos, lobe.f0.r), fresnel_schlick(cos, lobe.f0.g), fresnel_schlick(cos, lobe.f0.b)};
  }
  const double f = fresnel_dielectric(cos, lobe.eta);
  return {f, f, f};
}

BsdfValue diffuse(const Lobe& lobe, const Vec3& wi) {
  if (!(wi.z > 0)) return {};
  const double density = wi.z / std::numbers::pi;
  return {density * lobe.weight, density};
}

// Walter et al. 2007, equations 20 and 14; in a rough dielectric it is reflection that is drawn with Fresnel's share.
BsdfValue rough_reflection(const Lobe& lobe, const Vec3& wo, const Vec3& wi) {
  const Microfacets facets(lobe.alpha);
  const Vec3 h = wo + wi;
  const double squared = dot(h, h);
  const double spread = facets.density(h, squared) / (4 * wo.z);
  // The microfacet halves the angle between directions of length 1: its cosine is half of their sum's length.
  const Rgb fresnel = reflected_by(lobe, 0.5 * std::sqrt(squared));
  const double lambda_i = facets.lambda(wi);
  const double density =
      Microfacets::masking(lobe.lambda) * spread * (lobe.kind == Lobe::Kind::rough_dielectric ? fresnel.r : 1);
  const double kept = lobe.scale * Microfacets::masking_shadowing(lobe.lambda, lambda_i) * spread;
  return {kept * (lobe.weight * fresnel), density};
}

// Walter et al. 2007, equations 21 and 17, with the indices divided by that behind the surface.
BsdfValue rough_refraction(const Lobe& lobe, const Vec3& wo, const Vec3& wi) {
  const Vec3 h = lobe.eta * wo + wi;
  const double squared = dot(h, h);
  const Vec3 m = h / (h.z < 0 ? -std::sqrt(squared) : std::sqrt(squared));
  const double cos_o = dot(wo, m), cos_i = dot(wi, m);
  if (!(cos_o > 0) || !(cos_i < 0)) return {};
  const double share = 1 - fresnel_dielectric(cos_o, lobe.eta);
  const double bend = lobe.eta * cos_o + cos_i;
  const Microfacets facets(lobe.alpha);
  const double spread = share * cos_o * facets.density(h, squared) / wo.z * (-cos_i / (bend * bend));
  const double kept = lobe.scale * Microfacets::masking_shadowing(lobe.lambda, facets.lambda(wi)) * spread;
  return {(kept * lobe.eta * lobe.eta) * (lobe.weight * lobe.tint), Microfacets::masking(lobe.lambda) * spread};
}

BsdfValue evaluate_lobe(const Lobe& lobe, const Vec3& wo, const Vec3& wi) {
  if (lobe.kind == Lobe::Kind::diffuse) return diffuse(lobe, wi);
  if (!is_spread(lobe.kind)) return {};
  if (wi.z > 0) return rough_reflection(lobe, wo, wi);
  if (wi.z < 0 && lobe.kind == Lobe::Kind::rough_dielectric) return rough_refraction(lobe, wo, wi);
  return {};
}

BsdfSample mirrored(const Vec3& wo) {
  BsdfSample sample;
  sample.direction = {-wo.x, -wo.y, wo.z};
  return sample;
}

// Reflection or refraction at a smooth surface, weights without the lobe's.
BsdfSample sharp(const Lobe& lobe, const Vec3& wo, double choice) {
  BsdfSample sample = mirrored(wo);
  sample.weight = {1, 1, 1};
  if (lobe.kind == Lobe::Kind::mirror) return sample;
  const bool by_fresnel = lobe.kind == Lobe::Kind::dielectric;
  if (by_fresnel && choice < fresnel_dielectric(wo.z, lobe.eta)) return sample;
  const auto refracted = refract(-wo, {0, 0, 1}, lobe.eta);
  if (!refracted) return sample;
  sample.direction = *refracted;
  sample.is_transmitted = true;
  sample.is_unbent = lobe.is_window && lobe.eta == 1;
  if (by_fresnel) sample.weight = lobe.eta * lobe.eta * lobe.tint;
  return sample;
}

// A direction of a lobe that spreads light.
std::optional<Vec3> sample_spread(const Lobe& lobe, const Vec3& wo, double choice, const Sample2& place) {
  if (lobe.kind == Lobe::Kind::diffuse) return cosine_hemisphere(place);
  const Vec3 m = Microfacets(lobe.alpha).sample_visible(wo, place);
  if (lobe.kind == Lobe::Kind::rough_dielectric && !(choice < fresnel_dielectric(dot(wo, m), lobe.eta))) {
    const auto refracted = refract(-wo, m, lobe.eta);
    if (!refracted || !(refracted->z < 0)) return std::nullopt;
    return refracted;
  }
  const Vec3 reflected = reflect(-wo, m);
  if (!(reflected.z > 0)) return std::nullopt;
  return reflected;
}

}  // namespace

Lobe* Bsdf::add(Lobe::Kind kind, const Rgb& weight, double importance, double alpha) {
  if (!(importance > 0)) return nullptr;
  assert(count_ < most_lobes);
  Lobe& lobe = lobes_[count_++];
  lobe.kind = kind;
  lobe.weight = weight;
  lobe.probability = importance;
  lobe.alpha = alpha;
  if (is_rough(kind)) lobe.lambda = Microfacets(alpha).lambda(wo_);
  lobe.scale = 1;
  lobe.is_window = false;
  total_ += importance;
  spreads_ |= is_spread(kind);
  return &lobe;
}

BsdfValue Bsdf::evaluate(const Vec3& wi) const {
  BsdfValue sum;
  for (std::size_t i = 0; i < count_; ++i) {
    const BsdfValue value = evaluate_lobe(lobes_[i], wo_, wi);
    sum.light += value.light;
    sum.density += lobes_[i].probability * value.density;
  }
  if (count_ > 0) sum.density /= total_;
  return sum;
}

std::optional<BsdfSample> Bsdf::sample(double choice, const Sample2& place) const {
  if (count_ == 0) return std::nullopt;
  double rest = choice * total_;
  std::size_t i = 0;
  while (i + 1 < count_ && rest >= lobes_[i].probability) rest -= lobes_[i++].probability;
  const Lobe& lobe = lobes_[i];
  // What is left of the choice is as good as a new one.
  const double second = std::min(rest / lobe.probability, 1.0);
  if (!is_spread(lobe.kind)) {
    BsdfSample sample = sharp(lobe, wo_, second);
    sample.weight = sample.weight * lobe.weight * (total_ / lobe.probability);
    return sample;
  }
  const auto direction = sample_spread(lobe, wo_, second, place);
  if (!direction) return std::nullopt;
  const BsdfValue value = evaluate(*direction);
  if (!(value.density > 0)) return std::nullopt;
  BsdfSample sample;
  sample.direction = *direction;
  sample.weight = value.light * (1 / value.density);
  sample.density = value.density;
  sample.is_transmitted = direction->z < 0;
  return sample;
}

}  // namespace tenon
