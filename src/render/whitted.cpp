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
    nodes_.push_back({static_cast<std::uint32_t>(i), 1, {1, 1, 1}, nullptr, {}, {}, {}});
  std::span<const RayQuery> rays = primary;
  for (;;) {
    shade(rays, hits, light);
    connect(hits, context);
    for (const Node& node : nodes_) {
      if (node.surface != nullptr) light[node.tree] += node.weight * node.local;
    }
    if (!next_wave()) return;
    hits_.resize(queries_.size());
    accelerator_.first_hits(queries_, hits_, context);
    rays = queries_;
    hits = hits_;
  }
}

// What needs no shadow rays, and the rays that come next.
void WhittedIntegrator::shade(std::span<const RayQuery> rays, std::span<const Hit> hits, std::span<Rgb> light) {
  surface_count_ = 0;
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
      node.normal = dot(hit.normal, ray.direction) > 0 ? -hit.normal : hit.normal;
      const Reflectance& surface = scene_.reflectance(hit.material);
      node.surface = &surface;
      const Rgb color = scene_.color(hit);
      node.local = scene_.emitted(hit) + surface.ambient * color * scene_.ambient(node.normal);
      node.diffuse = surface.diffuse * color;
      add_surface(static_cast<std::uint32_t>(i), ray, hit);
      branch(ray, hit, node);
    } else {
      light[node.tree] += node.weight * scene_.beyond(ray.direction, node.level == 1, true);
    }
  }
}

void WhittedIntegrator::add_surface(std::uint32_t node, const Ray& ray, const Hit& hit) {
  const std::size_t number = surface_count_ / block_size, i = surface_count_ % block_size;
  if (number == surfaces_.size()) surfaces_.emplace_back();
  SurfaceBlock& block = surfaces_[number];
  block.nodes[i] = node;
  block.point.set(i, hit.point);
  block.normal.set(i, nodes_[node].normal);
  block.direction.set(i, ray.direction);
  ++surface_count_;
}

// The light that comes straight from lights.
void WhittedIntegrator::connect(std::span<const Hit> hits, TraceContext& context) {
  shadow_count_ = 0;
  for (const LitLight& light : scene_.lights()) {
    if (light.environment() != nullptr) continue;
    for (std::size_t first = 0; first < surface_count_; first += block_size) {
      aim_at_light(light, surfaces_[first / block_size], std::min(block_size, surface_count_ - first), hits);
    }
  }
  const std::span<const RayQuery> queries(shadow_queries_.data(), shadow_count_);
  if (scene_.has_transmission()) return connect_through(queries, hits, context);
  occluded_.resize(queries.size());
  accelerator_.occluded(queries, occluded_, context);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (occluded_[k] == 0) nodes_[shadow_rays_[k].node].local += sent_back(shadow_rays_[k]);
  }
}

// The same by shadow rays that boundaries may let through.
void WhittedIntegrator::connect_through(std::span<const RayQuery> queries, std::span<const Hit> hits,
                                        TraceContext& context) {
  const auto start = [&](std::size_t k) { return hits[shadow_rays_[k].node].before; };
  const auto let_through = [this](const Hit& boundary, const RayQuery& query) {
    const Vec3& direction = query.ray.direction;
    const double share = transmitted(boundary, 1 / length(direction) * direction);
    return Rgb{share, share, share};
  };
  const std::span<const Rgb> shares = straight_light_.shares(queries, start, let_through, context);
  for (std::size_t k = 0; k < queries.size(); ++k) {
    if (shares[k] != Rgb{}) nodes_[shadow_rays_[k].node].local += shares[k] * sent_back(shadow_rays_[k]);
  }
}

// What a surface sends back of the light that a shadow ray brings.
Rgb WhittedIntegrator::sent_back(const ShadowRay& ray) const {
  const Node& node = nodes_[ray.node];
  const Reflectance& surface = *node.surface;
  Rgb factor = ray.incidence * node.diffuse;
  if (surface.specular > 0) {
    const double highlight = surface.specular * power(std::max(0.0, ray.highlight), surface.shininess);
    factor += Rgb{highlight, highlight, highlight};
  }
  return ray.incident * factor;
}

// The shadow rays of a block's surfaces that face a light.
void WhittedIntegrator::aim_at_light(const LitLight& light, const SurfaceBlock& block, std::size_t count,
                                     std::span<const Hit> hits) {
  light.at(block.point, count, incident_);
  find_light_angles(block.normal, incident_.to_light, block.direction, count, angles_);
  if (shadow_queries_.size() < shadow_count_ + count) {
    RayQuery query;
    query.kind = RayKind::shadow;  // which stays, whatever else is overwritten
    shadow_queries_.resize(shadow_count_ + block_size, query);
    shadow_rays_.resize(shadow_count_ + block_size);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!(angles_.incidence[i] > 0)) continue;
    // Part by part, where they stay: a copy of what was just put together waits for all of its parts.
    RayQuery& query = shadow_queries_[shadow_count_];
    query.ray.origin = block.point[i];
    query.ray.direction = incident_.to_light[i];
    query.t_max = incident_.t_max[i];
    query.from = &hits[block.nodes[i]];
    ShadowRay& ray = shadow_rays_[shadow_count_];
    ray.node = block.nodes[i];
    ray.incidence = angles_.incidence[i];
    ray.highlight = angles_.highlight[i];
    ray.incident = incident_.light[i];
    if (ray.incident == Rgb{} || scene_.is_blocked_by_light(query.ray, query.t_max, &light)) continue;
    ++shadow_count_;
  }
}

// The share of the light that a boundary lets through to what lies straight behind it.
double WhittedIntegrator::transmitted(const Hit& boundary, const Vec3& direction) const {
  const Reflectance& surface = scene_.reflectance(boundary.material);
  if (!(surface.fresnel > 0)) return surface.transmitted;
  const double eta = scene_.ior(boundary.before) / scene_.ior(boundary.after);
  return surface.transmitted * (1 - fresnel_dielectric(std::fabs(dot(boundary.normal, direction)), eta));
}

void WhittedIntegrator::branch(const Ray& ray, const Hit& hit, const Node& node) {
  if (node.level >= limits_.depth) return;
  const Reflectance& surface = *node.surface;
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
    nodes_[count++] = {node.tree, next.level, next.weight, nullptr, {}, {}, {}};
    pending.pop_back();
  }
  nodes_.resize(count);
  for (std::size_t i = 0; i < count; ++i) queries_[i].from = &from_[i];
  return count > 0;
}

}  // namespace tenon
