#include "render/path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/sphere_sampling.h"

namespace tenon {

namespace {

// The pairs of numbers that a bounce takes (Sampler).
enum BouncePair : std::uint32_t { light_choice, direction, pairs_per_bounce };

std::uint32_t pair_of(int bounce, BouncePair pair) {
  return sample_pair::first_bounce + static_cast<std::uint32_t>(bounce) * pairs_per_bounce + pair;
}

}  // namespace

void PathIntegrator::radiance(std::span<const RayQuery> primary, std::span<const Hit> hits,
                              std::span<const SampleId> samples, std::span<Rgb> light, TraceContext& context) {
  std::fill(light.begin(), light.end(), Rgb{});
  paths_.resize(primary.size());
  for (std::size_t i = 0; i < paths_.size(); ++i) paths_[i] = {{1, 1, 1}, static_cast<std::uint32_t>(i)};
  std::span<const RayQuery> rays = primary;
  for (int bounce = 0;; ++bounce) {
    next_paths_.clear();
    next_queries_.clear();
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      const std::uint32_t slot = paths_[i].slot;
      shade(paths_[i], rays[i], hits[i], samples[slot], bounce, light[slot]);
    }
    trace_shadow_rays(light, context);
    if (next_paths_.empty()) return;
    next_hits_.resize(next_queries_.size());
    accelerator_.first_hits(next_queries_, next_hits_, context);
    // The queries point into the hits they start at, which live until the next bounce is traced.
    std::swap(paths_, next_paths_);
    std::swap(queries_, next_queries_);
    std::swap(hits_, next_hits_);
    rays = queries_;
    hits = hits_;
  }
}

void PathIntegrator::shade(const Path& path, const RayQuery& query, const Hit& hit, const SampleId& sample, int bounce,
                           Rgb& light) {
  if (!hit.found()) {
    light += path.throughput * (bounce == 0 ? scene_.background() : scene_.ambient());
    return;
  }
  const Vec3& d = query.ray.direction;
  const Vec3 normal = dot(hit.normal, d) > 0 ? -hit.normal : hit.normal;
  const Rgb& albedo = scene_.reflectance(hit.material).diffuse;
  const Sample2 choice = sampler_(sample, pair_of(bounce, light_choice));
  connect(path, hit, normal, albedo, choice.u);
  if (bounce + 1 >= depth_) return;

  // A path that carries little goes on seldom, and then carries more.
  Path next = path;
  next.throughput = path.throughput * albedo;
  const double most = std::max({next.throughput.r, next.throughput.g, next.throughput.b});
  const double survival = std::min(1.0, most);
  if (!(choice.v < survival)) return;
  next.throughput = next.throughput * (1 / survival);
  RayQuery onward;
  onward.ray = {hit.point, Frame(normal).to_world(cosine_hemisphere(sampler_(sample, pair_of(bounce, direction))))};
  onward.kind = RayKind::diffuse;
  onward.from = &hit;
  next_paths_.push_back(next);
  next_queries_.push_back(onward);
}

void PathIntegrator::connect(const Path& path, const Hit& hit, const Vec3& normal, const Rgb& albedo, double choice) {
  const std::vector<LitLight>& lights = scene_.lights();
  if (lights.empty()) return;
  const auto count = static_cast<double>(lights.size());
  const LitLight& chosen = lights[std::min(lights.size() - 1, static_cast<std::size_t>(choice * count))];
  const IncidentLight incident = chosen.at(hit.point);
  const double cos_light = dot(normal, normalize(incident.to_light));
  if (!(cos_light > 0)) return;
  const Rgb sent = path.throughput * albedo * incident.light * (cos_light * count);
  if (sent == Rgb{}) return;
  RayQuery query;
  query.ray = {hit.point, incident.to_light};
  query.t_max = incident.t_max;
  query.kind = RayKind::shadow;
  query.from = &hit;
  shadow_queries_.push_back(query);
  shadow_rays_.push_back({sent, path.slot});
}

void PathIntegrator::trace_shadow_rays(std::span<Rgb> light, TraceContext& context) {
  occluders_.resize(shadow_queries_.size());
  accelerator_.first_boundaries(shadow_queries_, occluders_, context);
  for (std::size_t i = 0; i < occluders_.size(); ++i) {
    if (!occluders_[i].found()) light[shadow_rays_[i].slot] += shadow_rays_[i].light;
  }
  shadow_queries_.clear();
  shadow_rays_.clear();
}

}  // namespace tenon
