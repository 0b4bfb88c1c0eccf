#include "render/whitted.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/optics.h"

namespace tenon {

void WhittedIntegrator::radiance(std::span<const RayQuery> primary, std::span<const Hit> hits,
                                 std::span<const SampleId>, std::span<Rgb> light, TraceContext& context) {
  for (std::size_t i = 0; i < primary.size(); ++i) light[i] = radiance(primary[i].ray, hits[i], context);
}

Rgb WhittedIntegrator::radiance(const Ray& primary, const Hit& first, TraceContext& context) {
  Rgb sum;
  Ray ray = primary;
  Hit hit = first;
  Rgb weight{1, 1, 1};
  int level = 1;
  pending_.clear();
  for (;;) {
    const auto lamp = scene_.first_light(ray, hit.t + hit.bound);
    const MediumId medium = hit.found() ? hit.before : medium_outside;
    weight = weight * scene_.attenuation(medium, lamp ? lamp->second.t : hit.t);
    if (lamp) {
      sum += weight * lamp->second.radiance;
    } else if (hit.found()) {
      const Vec3 normal = dot(hit.normal, ray.direction) > 0 ? -hit.normal : hit.normal;
      sum += weight * local_light(ray, hit, normal, context);
      branch(ray, hit, normal, weight, level);
    } else {
      sum += weight * scene_.beyond(ray.direction, level == 1, true);
    }
    if (pending_.empty()) return sum;

    const Pending next = std::move(pending_.back());
    pending_.pop_back();
    ray = next.ray;
    weight = next.weight;
    level = next.level;
    RayQuery query;
    query.ray = ray;
    query.kind = next.kind;
    query.from = &next.from;
    hit = accelerator_.first_hit(query, context);
  }
}

Rgb WhittedIntegrator::local_light(const Ray& ray, const Hit& hit, const Vec3& normal, TraceContext& context) {
  const Reflectance& surface = scene_.reflectance(hit.material);
  const Rgb color = scene_.color(hit);
  Rgb sum = scene_.emitted(hit) + surface.ambient * color * scene_.ambient();
  const Rgb diffuse = surface.diffuse * color;
  for (const LitLight& light : scene_.lights()) {
    const IncidentLight incident = light.at(hit.point);
    if (incident.light == Rgb{}) continue;
    const Vec3 to_light = normalize(incident.to_light);
    const double cos_light = dot(normal, to_light);
    if (!(cos_light > 0)) continue;
    const Rgb share = transmittance(hit, light, incident, context);
    if (share == Rgb{}) continue;

    const Vec3 half = normalize(to_light - ray.direction);
    const double highlight = surface.specular * std::pow(std::max(0.0, dot(normal, half)), surface.shininess);
    sum += share * (incident.light * (cos_light * diffuse + Rgb{highlight, highlight, highlight}));
  }
  return sum;
}

// The share of the light that a boundary lets through to what lies straight behind it.
double WhittedIntegrator::transmitted(const Hit& boundary, const Vec3& direction) const {
  const Reflectance& surface = scene_.reflectance(boundary.material);
  if (!(surface.fresnel > 0)) return surface.transmitted;
  const double eta = scene_.ior(boundary.before) / scene_.ior(boundary.after);
  return surface.transmitted * (1 - fresnel_dielectric(std::fabs(dot(boundary.normal, direction)), eta));
}

// What reaches the hit: each boundary on the way lets kt through.
Rgb WhittedIntegrator::transmittance(const Hit& hit, const LitLight& light, const IncidentLight& incident,
                                     TraceContext& context) {
  RayQuery query;
  query.ray = {hit.point, incident.to_light};
  query.t_max = incident.t_max;
  query.kind = RayKind::shadow;
  query.from = &hit;
  if (scene_.is_blocked_by_light(query.ray, query.t_max, &light)) return {};
  passed_.clear();
  const Vec3 direction = normalize(incident.to_light);
  const auto stops = [&](const Hit& boundary) {
    const double share = transmitted(boundary, direction);
    if (!(share > 0)) return true;
    passed_.add(boundary, {share, share, share});
    return false;
  };
  if (accelerator_.any_hit(query, stops, context)) return {};
  return passed_.left(scene_, hit.before, length(incident.to_light), incident.t_max);
}

void WhittedIntegrator::branch(const Ray& ray, const Hit& hit, const Vec3& normal, const Rgb& weight, int level) {
  if (level >= limits_.depth) return;
  const Reflectance& surface = scene_.reflectance(hit.material);
  // An opaque solid behind the surface takes what the surface lets through.
  const bool lets_through = surface.transmitted > 0 && hit.after != medium_opaque;
  const double eta = scene_.ior(hit.before) / (lets_through ? scene_.ior(hit.after) : surface.ior);
  const double fresnel = surface.fresnel > 0 ? fresnel_dielectric(-dot(normal, ray.direction), eta) : 0;
  const double mirrored = surface.fresnel * fresnel;
  Rgb reflected = surface.reflected + Rgb{mirrored, mirrored, mirrored};
  if (lets_through) {
    const Rgb through = surface.fresnel > 0 ? surface.transmitted * (1 - fresnel) * scene_.color(hit)
                                            : surface.transmitted * Rgb{1, 1, 1};
    if (const auto direction = refract(ray.direction, normal, eta)) {
      push(hit, *direction, RayKind::refracted, weight * through, level + 1);
    } else {
      reflected += through;
    }
  }
  push(hit, reflect(ray.direction, normal), RayKind::reflected, weight * reflected, level + 1);
}

void WhittedIntegrator::push(const Hit& from, const Vec3& direction, RayKind kind, const Rgb& weight, int level) {
  if (std::max({weight.r, weight.g, weight.b}) <= limits_.threshold) return;
  pending_.push_back({{from.point, direction}, kind, level, weight, from});
}

}  // namespace tenon
