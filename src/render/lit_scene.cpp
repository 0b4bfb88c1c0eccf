#include "render/lit_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tenon/math/affine3.h"

namespace tenon {

namespace {

Reflectance reflectance_of(const Material& material, const Rgb& ambient_light) {
  const Rgb color = linear_from_srgb(material.color.value_or(Rgba{1, 1, 1, 1}));
  Reflectance r;
  r.ambient = material.ka.value_or(material.kd) * color * ambient_light;
  r.diffuse = material.kd * color;
  r.specular = material.ks;
  r.shininess = material.shininess;
  if (material.model == MaterialModel::whitted) {
    r.reflected = material.ks;
    r.transmitted = material.kt;
  }
  return r;
}

}  // namespace

LitLight::LitLight(const Light& light)
    : kind_(light.kind),
      position_(light.position),
      direction_(normalize(light.direction)),
      cos_inner_(cos_degrees(light.angle * (1 - light.softness))),
      cos_outer_(cos_degrees(light.angle)),
      emitted_(light.intensity * linear_from_srgb(light.color)) {}

IncidentLight LitLight::at(const Vec3& point) const {
  if (kind_ == LightKind::directional) return {-direction_, std::numeric_limits<double>::infinity(), emitted_};
  const Vec3 to_light = position_ - point;
  return {to_light, 1, kind_ == LightKind::spot ? spot_share(to_light) * emitted_ : emitted_};
}

// 1 in the inner cone, 0 outside the outer one; between them the smooth step, which has no visible edge.
double LitLight::spot_share(const Vec3& to_light) const {
  const double cos_angle = -dot(normalize(to_light), direction_);
  if (cos_angle >= cos_inner_) return 1;
  if (cos_angle <= cos_outer_) return 0;
  const double x = (cos_angle - cos_outer_) / (cos_inner_ - cos_outer_);
  return x * x * (3 - 2 * x);
}

Rgb LitScene::albedo(const Hit& hit) const {
  const Reflectance& surface = reflectance(hit.material);
  const double specular = surface.specular + surface.transmitted;
  const auto share = [specular](double diffuse) { return std::clamp(diffuse + specular, 0.0, 1.0); };
  return {share(surface.diffuse.r), share(surface.diffuse.g), share(surface.diffuse.b)};
}

LitScene::LitScene(const Scene& scene)
    : default_material_(reflectance_of(scene.default_material, scene.ambient)),
      medium_ior_(scene.medium_ior),
      background_(scene.background),
      ambient_(scene.ambient) {
  materials_.reserve(scene.materials.size());
  for (const Material& m : scene.materials) materials_.push_back(reflectance_of(m, scene.ambient));
  lights_.reserve(scene.lights.size());
  for (const Light& l : scene.lights) lights_.emplace_back(l);
}

}  // namespace tenon
