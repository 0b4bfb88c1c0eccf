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

}  // namespace

/// What is known of the points of a block.
struct Surface::Points {
  const Vec3Block& wo;
  const RgbBlock& color;
  std::size_t size;  // of the block, in whole vectors
};

namespace {

NumberBlock same(double value) {
  NumberBlock block;
  block.fill(value);
  return block;
}

void add_diffuse(const RgbBlock& color, const NumberBlock& share, Bsdf& bsdf) {
  Lobe& lobe = bsdf.add(Lobe::Kind::diffuse);
  for (std::size_t i = 0; i < bsdf.size(); ++i) {
    lobe.weight.set(i, share[i] * color[i]);
    lobe.importance[i] = share[i] * largest(color[i]);
  }
}

void add_grey(Lobe& lobe, double weight, std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) {
    lobe.weight.set(i, grey(weight));
    lobe.importance[i] = weight;
  }
}

// What single scattering loses comes back with it, in its own directions (Turquin, "Practical multiple scattering
// compensation for microfacet models", 2019).
// @param f0  what it reflects straight on
void add_conductor(const Vec3Block& wo, const RgbBlock& f0, const NumberBlock& share, double alpha,
                   AlbedoTables& tables, Bsdf& bsdf) {
  if (alpha == 0) {
    Lobe& lobe = bsdf.add(Lobe::Kind::mirror);
    for (std::size_t i = 0; i < bsdf.size(); ++i) {
      const double cos = wo.z[i];
      const Rgb reflected{fresnel_schlick(cos, f0.r[i]), fresnel_schlick(cos, f0.g[i]), fresnel_schlick(cos, f0.b[i])};
      lobe.weight.set(i, share[i] * reflected);
      lobe.importance[i] = share[i] * largest(reflected);
    }
    return;
  }
  NumberBlock kept;
  tables.get(ScatteredPart::reflected_by_perfect_mirrors, alpha).find(wo.z, bsdf.size(), kept);
  Lobe& lobe = bsdf.add(Lobe::Kind::conductor, alpha);
  for (std::size_t i = 0; i < bsdf.size(); ++i) {
    const double lost_over_kept = 1 / kept[i] - 1;
    lobe.weight.set(i, share[i] * (grey(1) + lost_over_kept * f0[i]));
    lobe.importance[i] = share[i] * largest(f0[i]);
    lobe.color.set(i, f0[i]);
  }
}

// @param albedo  what of the light it reflects
void add_gloss(const Vec3Block& wo, const NumberBlock& share, const NumberBlock& albedo, double alpha, double eta,
               Bsdf& bsdf) {
  Lobe& lobe = bsdf.add(alpha == 0 ? Lobe::Kind::mirror : Lobe::Kind::gloss, alpha);
  lobe.eta = eta;
  for (std::size_t i = 0; i < bsdf.size(); ++i) {
    lobe.weight.set(i, grey(alpha == 0 ? share[i] * fresnel_dielectric(wo.z[i], eta) : share[i]));
    lobe.importance[i] = share[i] * albedo[i];
  }
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
      tables_(tables) {}

void Surface::scatter(const Vec3Block& wo, const RgbBlock& color, const Boundary& boundary, std::size_t count,
                      Bsdf& bsdf) const {
  bsdf.start(wo, count);
  add_lobes({wo, color, bsdf.size()}, boundary, bsdf);
  bsdf.complete();
}

void Surface::add_lobes(const Points& at, const Boundary& boundary, Bsdf& bsdf) const {
  switch (model_) {
    case MaterialModel::lambert:
      return add_diffuse(at.color, same(1), bsdf);
    case MaterialModel::phong:
      add_diffuse(at.color, same(kd_), bsdf);
      if (ks_ > 0) add_conductor(at.wo, {same(1), same(1), same(1)}, same(ks_), alpha_, tables_, bsdf);
      return;
    case MaterialModel::whitted:
      add_diffuse(at.color, same(kd_), bsdf);
      if (ks_ > 0) add_grey(bsdf.add(Lobe::Kind::mirror), ks_, at.size);
      if (kt_ > 0 && !boundary.is_opaque_behind) {
        Lobe& through = bsdf.add(Lobe::Kind::refraction);
        add_grey(through, kt_, at.size);
        through.eta = boundary.ior_before / boundary.ior_behind;
        through.is_window = true;
      }
      return;
    case MaterialModel::conductor:
      return add_conductor(at.wo, at.color, same(1), alpha_, tables_, bsdf);
    case MaterialModel::dielectric:
      return add_dielectric(at, same(1), boundary, bsdf);
    case MaterialModel::principled:
      return add_principled(at, boundary, bsdf);
  }
}

Rgb Surface::unbent(const Rgb& color, const Boundary& boundary) const {
  if (boundary.ior_before != boundary.ior_behind || boundary.is_opaque_behind) return {};
  if (model_ == MaterialModel::whitted) return grey(kt_);
  if (model_ == MaterialModel::dielectric) return color;
  return {};
}

// The share of the light that a dielectric's surface returns, or scatters in whatever direction.
void Surface::find_albedo(ScatteredPart part, const Points& at, double alpha, double eta, NumberBlock& albedo) const {
  if (alpha > 0) return tables_.get(part, alpha, eta).find(at.wo.z, at.size, albedo);
  for (std::size_t i = 0; i < at.size; ++i) albedo[i] = fresnel_dielectric(at.wo.z[i], eta);
}

void Surface::add_dielectric(const Points& at, const NumberBlock& share, const Boundary& boundary, Bsdf& bsdf) const {
  NumberBlock albedo;
  if (boundary.is_opaque_behind) {
    const double eta = boundary.ior_before / ior_;
    find_albedo(ScatteredPart::reflected_by_dielectric, at, alpha_, eta, albedo);
    return add_gloss(at.wo, share, albedo, alpha_, eta, bsdf);
  }
  const double eta = boundary.ior_before / boundary.ior_behind;
  // Between media of one index there is nothing to reflect at or to bend light.
  const bool smooth = alpha_ == 0 || eta == 1;
  Lobe& both = bsdf.add(smooth ? Lobe::Kind::dielectric : Lobe::Kind::rough_dielectric, alpha_);
  both.eta = eta;
  both.is_window = model_ == MaterialModel::dielectric;
  if (smooth) {
    albedo = same(1);
  } else {
    find_albedo(ScatteredPart::all_of_dielectric, at, alpha_, eta, albedo);
  }
  for (std::size_t i = 0; i < at.size; ++i) {
    both.weight.set(i, grey(share[i] / albedo[i]));
    both.importance[i] = share[i];
    both.color.set(i, at.color[i]);
  }
}

// Each layer passes on what it does not reflect (albedo scaling).
void Surface::add_principled(const Points& at, const Boundary& boundary, Bsdf& bsdf) const {
  NumberBlock rest = same(1), albedo, share;
  const auto scale = [&at](const NumberBlock& from, double by, NumberBlock& to) {
    for (std::size_t i = 0; i < at.size; ++i) to[i] = by * from[i];
  };
  if (coat_ > 0) {
    const double eta = boundary.ior_before / coat_ior;
    find_albedo(ScatteredPart::reflected_by_dielectric, at, coat_alpha_, eta, albedo);
    add_gloss(at.wo, same(coat_), albedo, coat_alpha_, eta, bsdf);
    for (std::size_t i = 0; i < at.size; ++i) rest[i] -= coat_ * albedo[i];
  }
  if (metallic_ > 0) {
    scale(rest, metallic_, share);
    add_conductor(at.wo, at.color, share, alpha_, tables_, bsdf);
  }
  scale(rest, 1 - metallic_, rest);
  if ((1 - metallic_) * transmission_ > 0) {
    scale(rest, transmission_, share);
    add_dielectric(at, share, boundary, bsdf);
  }
  scale(rest, 1 - transmission_, rest);
  if (!((1 - metallic_) * (1 - transmission_) > 0)) return;
  const double eta = boundary.ior_before / ior_;
  find_albedo(ScatteredPart::reflected_by_dielectric, at, alpha_, eta, albedo);
  add_gloss(at.wo, rest, albedo, alpha_, eta, bsdf);
  for (std::size_t i = 0; i < at.size; ++i) rest[i] *= 1 - albedo[i];
  add_diffuse(at.color, rest, bsdf);
}

}  // namespace tenon
