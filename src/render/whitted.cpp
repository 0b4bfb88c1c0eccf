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
  double weight = 1;
  int level = 1;
  pending_.clear();
  for (;;) {
    if (hit.found()) {
      const Vec3 normal = dot(hit.normal, ray.direction) > 0 ? -hit.normal : hit.normal;
      sum += weight * local_light(ray, hit, normal, context);
      branch(ray, hit, normal, weight, level);
    } else {
      sum += weight * scene_.background();
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
  Rgb sum = surface.ambient;
  for (const LitLight& light : scene_.lights()) {
    const IncidentLight incident = light.at(hit.point);
    if (incident.light == Rgb{}) continue;
    const Vec3 to_light = normalize(incident.to_light);
    const double cos_light = dot(normal, to_light);
    if (!(cos_light > 0)) continue;
    const double share = transmittance(hit, incident, context);
    if (!(share > 0)) continue;

    const Vec3 half = normalize(to_light - ray.direction);
    const double highlight = surface.specular * std::pow(std::max(0.0, dot(normal, half)), surface.shininess);
    sum += share * (incident.light * (cos_light * surface.diffuse + Rgb{highlight, highlight, highlight}));
  }
  return sum;
}

// The share of the light that reaches the hit: each boundary on the way lets kt of it through.
double WhittedIntegrator::transmittance(const Hit& hit, const IncidentLight& incident, TraceContext& context) {
  RayQuery query;
  query.ray = {hit.point, incident.to_light};
  query.t_max = incident.t_max;
  query.kind = RayKind::shadow;
  query.from = &hit;
  factors_.clear();
  const auto stops = [this](const Hit& boundary) {
    const double kt = scene_.reflectance(boundary.material).transmitted;
    if (!(kt > 0)) return true;
    factors_.push_back(kt);
    return false;
  };
  if (accelerator_.any_hit(query, stops, context)) return 0;
  // A structure may report boundaries in any order; sorted factors make the product the same for all of them.
  std::sort(factors_.begin(), factors_.end());
  double product = 1;
  for (double kt : factors_) product *= kt;
  return product;
}

void WhittedIntegrator::branch(const Ray& ray, const Hit& hit, const Vec3& normal, double weight, int level) {
  if (level >= limits_.depth) return;
  const Reflectance& surface = scene_.reflectance(hit.material);
  double reflected = surface.reflected;
  // An opaque solid behind the surface takes what the surface lets through.
  if (surface.transmitted > 0 && hit.after != medium_opaque) {
    const double eta = scene_.ior(hit.before) / scene_.ior(hit.after);
    if (const auto direction = refract(ray.direction, normal, eta)) {
      push(hit, *direction, RayKind::refracted, weight * surface.transmitted, level + 1);
    } else {
      reflected += surface.transmitted;
    }
  }
  push(hit, reflect(ray.direction, normal), RayKind::reflected, weight * reflected, level + 1);
}

void WhittedIntegrator::push(const Hit& from, const Vec3& direction, RayKind kind, double weight, int level) {
  if (weight > limits_.threshold) pending_.push_back({{from.point, direction}, kind, level, weight, from});
}

}  // namespace tenon
