#include "render/surface.h"

#include <algorithm>
#include <cmath>

#include "render/optics.h"

namespace tenon {

namespace {

constexpr double coat_ior = 1.5;

double largest(const Rgb& c) {
  return std::max({c.r, c.g, c.b});
}

// Below this width GGX is narrower than the rounding of the directions that it is a function of: a mirror.
double alpha_of(double roughness) {
  const double alpha = roughness * roughness;
  return alpha < 0x1p-13 ? 0 : alpha;
}

// The highlight of Phong's exponent n as GGX: the same curvature at its top.
double alpha_of_exponent(double n) {
  return std::sqrt(2 / (n + 2));
}

Rgb grey(double value) {
  return {value, value, value};
}

// What single scattering loses comes back with it, in its own directions (Turquin, "Practical multiple scattering
// compensation for microfacet models", 2019).
void add_conductor(Bsdf& bsdf, double cos, double alpha, const Rgb& f0, double share, const AlbedoTable* table) {
  if (alpha == 0) {
    const Rgb reflected{fresnel_schlick(cos, f0.r), fresnel_schlick(cos, f0.g), fresnel_schlick(cos, f0.b)};
    bsdf.add(Lobe::Kind::mirror, share * reflected, share * largest(reflected));
    return;
  }
  const double lost_over_kept = 1 / (*table)(cos)-1;
  const Rgb weight = share * (grey(1) + lost_over_kept * f0);
  if (Lobe* rough = bsdf.add(Lobe::Kind::conductor, weight, share * largest(f0), alpha)) rough->f0 = f0;
}

}  // namespace

Surface::Surface(const Material& material, AlbedoTables& tables)
    : model_(material.model),
      kd_(material.kd),
      ks_(material.ks),
      kt_(material.kt),
      alpha_(model_ == MaterialModel::phong ? alpha_of_exponent(material.shininess) : alpha_of(material.roughness)),
      metallic_(material.metallic),
      transmission_(material.transmission),
      coat_(material.coat),
      coat_alpha_(alpha_of(material.coat_roughness)),
      ior_(material.ior),
      tables_(tables) {
  const bool has_conductor = model_ == MaterialModel::conductor || (model_ == MaterialModel::phong && ks_ > 0) ||
                             (model_ == MaterialModel::principled && metallic_ > 0);
  if (has_conductor && alpha_ > 0) conductor_ = &tables.get(ScatteredPart::reflected_by_perfect_mirrors, alpha_);
}

Bsdf Surface::bsdf(const Vec3& wo, const Rgb& color, const Boundary& boundary) const {
  Bsdf bsdf(wo);
  switch (model_) {
    case MaterialModel::lambert:
      bsdf.add(Lobe::Kind::diffuse, color, 1);
      break;
    case MaterialModel::phong:
      bsdf.add(Lobe::Kind::diffuse, kd_ * color, kd_ * largest(color));
      if (ks_ > 0) add_conductor(bsdf, wo.z, alpha_, {1, 1, 1}, ks_, conductor_);
      break;
    case MaterialModel::whitted:
      bsdf.add(Lobe::Kind::diffuse, kd_ * color, kd_ * largest(color));
      bsdf.add(Lobe::Kind::mirror, grey(ks_), ks_);
      if (boundary.is_opaque_behind) break;
      if (Lobe* through = bsdf.add(Lobe::Kind::refraction, grey(kt_), kt_)) {
        through->eta = boundary.ior_before / boundary.ior_behind;
        through->is_window = true;
      }
      break;
    case MaterialModel::conductor:
      add_conductor(bsdf, wo.z, alpha_, color, 1, conductor_);
      break;
    case MaterialModel::dielectric:
      add_dielectric(bsdf, wo.z, color, 1, boundary);
      break;
    case MaterialModel::principled:
      add_principled(bsdf, wo.z, color, boundary);
      break;
  }
  return bsdf;
}

Rgb Surface::unbent(const Rgb& color, const Boundary& boundary) const {
  if (boundary.ior_before != boundary.ior_behind || boundary.is_opaque_behind) return {};
  if (model_ == MaterialModel::whitted) return grey(kt_);
  if (model_ == MaterialModel::dielectric) return color;
  return {};
}

double Surface::reflected_by_dielectric(double cos, double alpha, double eta) const {
  if (alpha == 0) return fresnel_dielectric(cos, eta);
  return tables_.get(ScatteredPart::reflected_by_dielectric, alpha, eta)(cos);
}

void Surface::add_dielectric(Bsdf& bsdf, double cos, const Rgb& tint, double share, const Boundary& boundary) const {
  if (boundary.is_opaque_behind) {
    const double eta = boundary.ior_before / ior_;
    add_gloss(bsdf, cos, alpha_, eta, share, reflected_by_dielectric(cos, alpha_, eta));
    return;
  }
  const double eta = boundary.ior_before / boundary.ior_behind;
  // Between media of one index there is nothing to reflect at or to bend light.
  const bool smooth = alpha_ == 0 || eta == 1;
  Lobe* both = bsdf.add(smooth ? Lobe::Kind::dielectric : Lobe::Kind::rough_dielectric, grey(share), share, alpha_);
  if (both == nullptr) return;
  both->tint = tint;
  both->eta = eta;
  both->is_window = model_ == MaterialModel::dielectric;
  if (!smooth) both->scale = 1 / tables_.get(ScatteredPart::all_of_dielectric, alpha_, eta)(cos);
}

void Surface::add_gloss(Bsdf& bsdf, double cos, double alpha, double eta, double share, double albedo) const {
  if (alpha == 0) {
    bsdf.add(Lobe::Kind::mirror, grey(share * fresnel_dielectric(cos, eta)), share * albedo);
    return;
  }
  if (Lobe* gloss = bsdf.add(Lobe::Kind::gloss, grey(share), share * albedo, alpha)) gloss->eta = eta;
}

// Each layer passes on what it does not reflect (albedo scaling).
void Surface::add_principled(Bsdf& bsdf, double cos, const Rgb& color, const Boundary& boundary) const {
  double rest = 1;
  if (coat_ > 0) {
    const double eta = boundary.ior_before / coat_ior;
    const double albedo = reflected_by_dielectric(cos, coat_alpha_, eta);
    add_gloss(bsdf, cos, coat_alpha_, eta, coat_, albedo);
    rest -= coat_ * albedo;
  }
  if (metallic_ > 0) add_conductor(bsdf, cos, alpha_, color, rest * metallic_, conductor_);
  rest *= 1 - metallic_;
  if (rest * transmission_ > 0) add_dielectric(bsdf, cos, color, rest * transmission_, boundary);
  rest *= 1 - transmission_;
  if (!(rest > 0)) return;
  const double eta = boundary.ior_before / ior_;
  const double albedo = reflected_by_dielectric(cos, alpha_, eta);
  add_gloss(bsdf, cos, alpha_, eta, rest, albedo);
  const double below = rest * (1 - albedo);
  bsdf.add(Lobe::Kind::diffuse, below * color, below * largest(color));
}

}  // namespace tenon
