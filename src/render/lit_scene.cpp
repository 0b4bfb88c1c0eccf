#include "render/lit_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "csg/csg_tree.h"
#include "render/optics.h"
#include "render/solid_texture.h"

namespace tenon {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// The course knows nothing of microfacets: what a newer model spreads is diffuse, and what it reflects is a mirror's.
Reflectance reflectance_of(const Material& material) {
  Reflectance r;
  r.shininess = material.shininess;
  r.ior = material.ior;
  const Rgb color = linear_from_srgb(material.color.value_or(Rgba{1, 1, 1, 1}));
  switch (material.model) {
    case MaterialModel::phong:
    case MaterialModel::whitted:
      r.ambient = material.ka.value_or(material.kd);
      r.diffuse = material.kd;
      r.specular = material.ks;
      if (material.model == MaterialModel::phong) break;
      r.reflected = {material.ks, material.ks, material.ks};
      r.transmitted = material.kt;
      break;
    case MaterialModel::lambert:
      r.ambient = r.diffuse = 1;
      break;
    case MaterialModel::conductor:
      r.reflected = color;
      break;
    case MaterialModel::dielectric:
      r.transmitted = r.fresnel = 1;
      break;
    case MaterialModel::principled:
      r.reflected = material.metallic * color;
      r.transmitted = (1 - material.metallic) * material.transmission;
      r.fresnel = 1 - material.metallic;
      r.ambient = r.diffuse = (1 - material.metallic) * (1 - material.transmission);
      break;
  }
  return r;
}

bool has_media_of_one_index(const std::vector<Medium>& media) {
  for (std::size_t i = medium_opaque + 1; i < media.size(); ++i) {
    if (media[i].ior == media[medium_outside].ior) return true;
    for (std::size_t j = i + 1; j < media.size(); ++j) {
      if (media[i].ior == media[j].ior) return true;
    }
  }
  return false;
}

}  // namespace

LitScene::LitScene(const Scene& scene)
    : media_(scene.media),
      has_unbent_(has_media_of_one_index(scene.media)),
      background_(scene.background),
      ambient_(scene.ambient),
      shows_around_(scene.shows_environment) {
  materials_.reserve(scene.materials.size() + 1);
  materials_.push_back(prepare(scene.default_material));
  for (const Material& m : scene.materials) materials_.push_back(prepare(m));
  has_transmission_ = std::any_of(materials_.begin(), materials_.end(),
                                  [](const Prepared& m) { return m.reflectance.transmitted > 0; });
  prepare_lights(scene);
}

LitScene::Prepared LitScene::prepare(const Material& material) {
  return {linear_from_srgb(material.color.value_or(Rgba{1, 1, 1, 1})),
          linear_from_srgb(material.texture.second),
          material.texture,
          material.emission,
          reflectance_of(material),
          Surface(material, AlbedoTables::shared())};
}

void LitScene::prepare_lights(const Scene& scene) {
  lights_.reserve(scene.lights.size());
  for (const Light& light : scene.lights) {
    const Environment* environment = light.is_around() ? &environments_.emplace_back(light) : nullptr;
    lights_.emplace_back(light, environment);
    has_light_surfaces_ |= lights_.back().has_surface();
    draws_places_of_lights_ |= lights_.back().has_extent();
    if (environment == nullptr) continue;
    around_ = &lights_.back();
    ambient_light_.emplace(*environment);
  }
  if (std::ranges::all_of(lights_, &LitLight::is_even)) even_importance_ = importance_of_all({});
  // A crossing lies within the tolerance of its face, divided by the slope, and so does the light's surface.
  if (scene.tree) margin_ = 2 * scene.tree->tolerance.distance;
}

Rgb LitScene::textured_color(const Prepared& material, const Hit& hit) const {
  // What lies under the face, further than the error of its place: a face that coincides with one of the pattern is of
  // one colour.
  const double share = second_share(material.texture, hit.point - margin_ * hit.normal);
  return (1 - share) * material.color + share * material.second;
}

Rgb LitScene::albedo(const Hit& hit) const {
  const Reflectance& r = reflectance(hit.material);
  const Rgb diffuse = r.diffuse * color(hit);
  const auto share = [&](double band, double reflected) {
    return std::clamp(band + std::max(r.specular, reflected) + r.transmitted, 0.0, 1.0);
  };
  return {share(diffuse.r, r.reflected.r), share(diffuse.g, r.reflected.g), share(diffuse.b, r.reflected.b)};
}

Boundary LitScene::boundary(const Hit& hit) const {
  return {ior(hit.before), ior(hit.after), hit.after == medium_opaque};
}

Rgb LitScene::attenuation_inside(MediumId medium, double length) const {
  const Rgb& k = media_[medium].attenuation;
  // Nothing is taken off by 0 however long the way.
  const auto left = [length](double band) { return band > 0 ? std::exp(-band * length) : 1; };
  return {left(k.r), left(k.g), left(k.b)};
}

Rgb LitScene::beyond(const Vec3& direction, bool is_camera_ray, bool is_sharp) const {
  if (around_ != nullptr) {
    return is_camera_ray && !shows_around_ ? background_ : around_->environment()->radiance(direction);
  }
  return is_sharp ? background_ : ambient_;
}

double LitScene::importance_of_all(const Vec3& point) const {
  if (even_importance_) return *even_importance_;
  double total = 0;
  for (const LitLight& light : lights_) total += light.importance(point);
  return total;
}

LightChoice LitScene::choose_light(const Vec3& point, double choice) const {
  const double total = importance_of_all(point);
  if (!(total > 0)) return {};
  double rest = choice * total;
  LightChoice last;
  for (const LitLight& light : lights_) {
    const double importance = light.importance(point);
    if (!(importance > 0)) continue;
    last = {&light, importance / total};
    if (rest < importance) break;
    rest -= importance;
  }
  return last;
}

double LitScene::choice_probability(const LitLight& light, const Vec3& point) const {
  const double total = importance_of_all(point);
  return total > 0 ? light.importance(point) / total : 0;
}

std::optional<std::pair<const LitLight*, LightHit>> LitScene::first_of_light_surfaces(const Ray& ray,
                                                                                      double t_max) const {
  std::optional<std::pair<const LitLight*, LightHit>> first;
  double nearest = inf;
  for (const LitLight& light : lights_) {
    const auto hit = light.intersect(ray);
    if (!hit || !(hit->t < nearest) || hit->t - light_margin(hit->cos) > t_max) continue;
    nearest = hit->t;
    first.emplace(&light, *hit);
  }
  return first;
}

bool LitScene::is_blocked_by_light_surface(const Ray& ray, double t_max, const LitLight* to) const {
  const double length_of_one = length(ray.direction);
  const Ray normal_ray{ray.origin, ray.direction / length_of_one};
  for (const LitLight& light : lights_) {
    if (&light == to) continue;
    const auto hit = light.intersect(normal_ray);
    if (hit && hit->t < t_max * length_of_one) return true;
  }
  return false;
}

}  // namespace tenon
