#include "render/whitted.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/optics.h"

namespace tenon {

namespace {

// x^n for x >= 0 and n > 0; by multiplication, which takes a third of the time, where n is a whole number.
double power(double x, double n) {
  constexpr double most = 1 << 16;
  if (!(n <= most) || n != static_cast<double>(static_cast<int>(n))) return std::pow(x, n);
  double product = 1;
  for (int left = static_cast<int>(n); left != 0; left >>= 1) {
    if ((left & 1) != 0) product *= x;
    x *= x;
  }
  return product;
}

}  // namespace

void WhittedIntegrator::radiance(std::span<const RayQuery> primary, std::span<const Hit> hits,
                                 std::span<const SampleId>, std::span<Rgb> light, TraceContext& context) {
  std::fill(light.begin(), light.end(), Rgb{});
  pending_.resize(std::max(pending_.size(), primary.size()));
  nodes_.clear();
  for (std::size_t i = 0; i < primary.size(); ++i)
    nodes_.push_back({static_cast<std::uint32_t>(i), 1, {1, 1, 1}, {}, {}, {}});
  std::span<const RayQuery> rays = primary;
  for (;;) {
    shade(rays, hits, light);
    connect(rays, hits, context);
    for (const std::uint32_t i : surfaces_) light[nodes_[i].tree] += nodes_[i].weight * nodes_[i].local;
    if (!next_wave()) return;
    hits_.resize(queries_.size());
    accelerator_.first_hits(queries_, hits_, context);
    rays = queries_;
    hits = hits_;
  }
}

// What needs no shadow rays, and the rays that come next.
void WhittedIntegrator::shade(std::span<const RayQuery> rays, std::span<const Hit> hits, std::span<Rgb> light) {
  surfaces_.clear();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Ray& ray = rays[i].ray;
    const Hit& hit = hits[i];
    Node& node = nodes_[i];
    const auto lamp = scene_.first_light(ray, hit.t);
    const MediumId medium = hit.found() ? hit.before : medium_outside;
    node.weight = node.weight * scene_.attenuation(medium, lamp ? lamp->second.t : hit.t);
    if (lamp) {
      light[node.tree] += node.weight * lamp->second.radiance;
    } else if (hit.found()) {
      surfaces_.push_back(static_cast<std::uint32_t>(i));
      node.normal = dot(hit.normal, ray.direction) > 0 ? -hit.normal : hit.normal;
      const Reflectance& surface = scene_.reflectance(hit.material);
      const Rgb color = scene_.color(hit);
      node.local = scene_.emitted(hit) + surface.ambient * color * scene_.ambient(node.normal);
      node.diffuse = surface.diffuse * color;
      branch(ray, hit, node);
    } else {
      light[node.tree] += node.weight * scene_.beyond(ray.direction, node.level == 1, true);
    }
  }
}

// The light that comes straight from lights.
void WhittedIntegrator::connect(std::span<const RayQuery> rays, std::span<const Hit> hits, TraceContext& context) {
  shadow_queries_.clear();
  shadow_rays_.clear();
  for (const LitLight& light : scene_.lights()) {
    for (const std::uint32_t i : surfaces_) {
      const IncidentLight incident = light.at(hits[i].point);
      if (incident.light == Rgb{}) continue;
      if (!(dot(nodes_[i].normal, incident.to_light) > 0)) continue;
      if (scene_.is_blocked_by_light({hits[i].point, incident.to_light}, incident.t_max, &light)) continue;
      // Part by part, where they stay: a copy of what was just put together waits for all of its parts.
      RayQuery& query = shadow_queries_.emplace_back();
      query.ray.origin = hits[i].point;
      query.ray.direction = incident.to_light;
      query.t_max = incident.t_max;
      query.kind = RayKind::shadow;
      query.from = &hits[i];
      ShadowRay& ray = shadow_rays_.emplace_back();
      ray.node = i;
      ray.incident = incident.light;
    }
  }
  find_shares(hits, context);
  for (std::uint32_t k = 0; k < shadow_rays_.size(); ++k) {
    if (shares_[k] == Rgb{}) continue;
    const std::uint32_t node = shadow_rays_[k].node;
    lit_.rays[lit_.count] = k;
    lit_.normal.set(lit_.count, nodes_[node].normal);
    lit_.to_light.set(lit_.count, shadow_queries_[k].ray.direction);
    lit_.direction.set(lit_.count, rays[node].ray.direction);
    if (++lit_.count == block_size) add_lit(hits);
  }
  add_lit(hits);
}

// What a block of shadow rays brings.
void WhittedIntegrator::add_lit(std::span<const Hit> hits) {
  find_light_angles(lit_.normal, lit_.to_light, lit_.direction, lit_.count, lit_.angles);
  for (std::size_t i = 0; i < lit_.count; ++i) {
    const std::uint32_t k = lit_.rays[i];
    const ShadowRay& ray = shadow_rays_[k];
    Node& node = nodes_[ray.node];
    const Reflectance& surface = scene_.reflectance(hits[ray.node].material);
    Rgb factor = lit_.angles.incidence[i] * node.diffuse;
    if (surface.specular > 0) {
      const double highlight = surface.specular * power(std::max(0.0, lit_.angles.highlight[i]), surface.shininess);
      factor += Rgb{highlight, highlight, highlight};
    }
    node.local += shares_[k] * (ray.incident * factor);
  }
  lit_.count = 0;
}

// How much of its light each shadow ray brings.
void WhittedIntegrator::find_shares(std::span<const Hit> hits, TraceContext& context) {
  shares_.resize(shadow_queries_.size());
  if (scene_.has_transmission()) {
    for (std::size_t k = 0; k < shares_.size(); ++k) {
      shares_[k] = transmittance(shadow_queries_[k], hits[shadow_rays_[k].node], context);
    }
    return;
  }
  occluded_.resize(shadow_queries_.size());
  accelerator_.occluded(shadow_queries_, occluded_, context);
  for (std::size_t k = 0; k < shares_.size(); ++k) shares_[k] = occluded_[k] != 0 ? Rgb{} : Rgb{1, 1, 1};
}

// The share of the light that a boundary lets through to what lies straight behind it.
double WhittedIntegrator::transmitted(const Hit& boundary, const Vec3& direction) const {
  const Reflectance& surface = scene_.reflectance(boundary.material);
  if (!(surface.fresnel > 0)) return surface.transmitted;
  const double eta = scene_.ior(boundary.before) / scene_.ior(boundary.after);
  return surface.transmitted * (1 - fresnel_dielectric(std::fabs(dot(boundary.normal, direction)), eta));
}

// What reaches the hit: each boundary on the way lets kt through.
Rgb WhittedIntegrator::transmittance(const RayQuery& query, const Hit& hit, TraceContext& context) {
  passed_.clear();
  const double distance = length(query.ray.direction);
  const Vec3 to_light = 1 / distance * query.ray.direction;
  const auto stops = [&](const Hit& boundary) {
    const double share = transmitted(boundary, to_light);
    if (!(share > 0)) return true;
    passed_.add(boundary, {share, share, share});
    return false;
  };
  if (accelerator_.any_hit(query, stops, context)) return {};
  return passed_.left(scene_, hit.before, distance, query.t_max);
}

void WhittedIntegrator::branch(const Ray& ray, const Hit& hit, const Node& node) {
  if (node.level >= limits_.depth) return;
  const Reflectance& surface = scene_.reflectance(hit.material);
  if (!surface.sends_on()) return;
  // An opaque solid behind the surface takes what the surface lets through.
  const bool lets_through = surface.transmitted > 0 && hit.after != medium_opaque;
  const double eta = scene_.ior(hit.before) / (lets_through ? scene_.ior(hit.after) : surface.ior);
  const double fresnel = surface.fresnel > 0 ? fresnel_dielectric(-dot(node.normal, ray.direction), eta) : 0;
  const double mirrored = surface.fresnel * fresnel;
  Rgb reflected = surface.reflected + Rgb{mirrored, mirrored, mirrored};
  if (lets_through) {
    const Rgb through = surface.fresnel > 0 ? surface.transmitted * (1 - fresnel) * scene_.color(hit)
                                            : surface.transmitted * Rgb{1, 1, 1};
    if (const auto direction = refract(ray.direction, node.normal, eta)) {
      push(hit, *direction, RayKind::refracted, node.weight * through, node);
    } else {
      reflected += through;
    }
  }
  push(hit, reflect(ray.direction, node.normal), RayKind::reflected, node.weight * reflected, node);
}

void WhittedIntegrator::push(const Hit& from, const Vec3& direction, RayKind kind, const Rgb& weight,
                             const Node& node) {
  if (std::max({weight.r, weight.g, weight.b}) <= limits_.threshold) return;
  pending_[node.tree].push_back({{from.point, direction}, kind, node.level + 1, weight, from});
}

// Takes the next ray of each tree of the wave; false when all are done.
bool WhittedIntegrator::next_wave() {
  std::size_t count = 0;
  queries_.clear();
  from_.clear();
  for (const Node& node : nodes_) {
    std::vector<Pending>& pending = pending_[node.tree];
    if (pending.empty()) continue;
    Pending& next = pending.back();
    RayQuery& query = queries_.emplace_back();
    query.ray = next.ray;
    query.kind = next.kind;
    from_.push_back(std::move(next.from));
    nodes_[count++] = {node.tree, next.level, next.weight, {}, {}, {}};
    pending.pop_back();
  }
  nodes_.resize(count);
  for (std::size_t i = 0; i < count; ++i) queries_[i].from = &from_[i];
  return count > 0;
}

}  // namespace tenon
