#include "render/path.h"

#include <algorithm>
#include <cmath>

namespace tenon {

namespace {

// The pairs of numbers that a bounce takes (Sampler).
enum BouncePair : std::uint32_t { choices, light_place, direction, roulette, pairs_per_bounce };

std::uint32_t pair_of(int bounce, BouncePair pair) {
  return sample_pair::first_bounce + static_cast<std::uint32_t>(bounce) * pairs_per_bounce + pair;
}

double largest(const Rgb& c) {
  return std::max({c.r, c.g, c.b});
}

}  // namespace

void PathIntegrator::radiance(std::span<const RayQuery> primary, std::span<const Hit> hits,
                              std::span<const SampleId> samples, std::span<Rgb> light, TraceContext& context) {
  std::fill(light.begin(), light.end(), Rgb{});
  paths_.assign(primary.size(), Path{});
  for (std::size_t i = 0; i < paths_.size(); ++i) paths_[i].slot = static_cast<std::uint32_t>(i);
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

void PathIntegrator::shade(Path path, const RayQuery& query, const Hit& hit, const SampleId& sample, int bounce,
                           Rgb& light) {
  const Vec3& d = query.ray.direction;
  const auto lamp = scene_.first_light(query.ray, hit.t + hit.bound);
  const MediumId medium = hit.found() ? hit.before : medium_outside;
  if (medium > medium_opaque)
    path.throughput = path.throughput * scene_.attenuation(medium, lamp ? lamp->second.t : hit.t);
  if (lamp) {
    const auto& [met, place] = *lamp;
    light += weight_of_met_light(path, *met, place.density) * (path.throughput * place.radiance);
    return;
  }
  if (!hit.found()) {
    const LitLight* around = scene_.around();
    const double share = around == nullptr ? 1 : weight_of_met_light(path, *around, around->environment()->density(d));
    light += share * (path.throughput * scene_.beyond(d, path.is_camera_ray, path.is_sharp));
    return;
  }
  light += path.throughput * scene_.emitted(hit);
  const Frame frame(dot(hit.normal, d) > 0 ? -hit.normal : hit.normal);
  const Vec3 wo = frame.to_local(-d);
  if (!(wo.z > 0)) return;  // along the surface, which then sends nothing that way
  const Bsdf bsdf = scene_.surface(hit.material).bsdf(wo, scene_.color(hit), scene_.boundary(hit));
  const Vertex vertex{hit, frame, bsdf, sample, bounce};
  const Sample2 choice = sampler_(sample, pair_of(bounce, choices));
  if (bsdf.spreads()) connect(path, vertex, choice.u);
  if (bounce + 1 < depth_) go_on(path, vertex, choice.v);
}

double PathIntegrator::weight(double density, double other) const {
  const double ratio = other / density;
  return 1 / (1 + ratio * ratio);
}

// Light with extent that a path runs into was to be found from the path's last vertex as well, unless the direction it
// took there was the only one.
double PathIntegrator::weight_of_met_light(const Path& path, const LitLight& light, double density) const {
  const bool is_drawn = !(light.environment() != nullptr && light.environment()->is_uniform());
  if (!(path.density > 0) || strategy_ == LightStrategy::bsdf || !is_drawn) return 1;
  if (strategy_ == LightStrategy::lights) return 0;
  return weight(path.density, density * scene_.choice_probability(light, path.vertex));
}

void PathIntegrator::connect(const Path& path, const Vertex& vertex, double choice) {
  const Hit& hit = vertex.hit;
  const LightChoice chosen = scene_.choose_light(hit.point, choice);
  if (chosen.light == nullptr) return;
  const Sample2 place =
      chosen.light->has_extent() ? sampler_(vertex.sample, pair_of(vertex.bounce, light_place)) : Sample2{};
  const auto sample = chosen.light->sample(hit.point, place);
  if (!sample) return;
  const double distance = length(sample->to_light);
  const Vec3 wi = vertex.frame.to_local(sample->to_light / distance);
  const BsdfValue value = vertex.bsdf.evaluate(wi);
  double share = 1 / chosen.probability;
  if (sample->density > 0) {
    if (strategy_ == LightStrategy::bsdf) return;
    if (strategy_ == LightStrategy::both) share *= weight(sample->density * chosen.probability, value.density);
  }
  const Rgb sent = share * (path.throughput * value.light * sample->light);
  if (!(largest(sent) > 0)) return;
  RayQuery query;
  query.ray = {hit.point, sample->to_light};
  query.t_max = sample->t_max;
  if (chosen.light->has_surface()) query.t_max -= scene_.light_margin(sample->cos) / distance;
  query.kind = RayKind::shadow;
  query.from = &hit;
  if (scene_.is_blocked_by_light(query.ray, query.t_max, chosen.light)) return;
  shadow_queries_.push_back(query);
  shadow_rays_.push_back({sent, path.slot, wi.z > 0 ? hit.before : hit.after});
}

void PathIntegrator::go_on(Path path, const Vertex& vertex, double choice) {
  const auto drawn = vertex.bsdf.sample(choice, sampler_(vertex.sample, pair_of(vertex.bounce, direction)));
  if (!drawn) return;
  const Hit& hit = vertex.hit;
  path.throughput = path.throughput * drawn->weight;
  if (drawn->is_transmitted) {
    const double eta = scene_.ior(hit.before) / scene_.ior(hit.after);
    path.growth *= eta * eta;
  }
  // A path that carries little goes on seldom, and then carries more.
  constexpr int certain_bounces = 3;
  const double survival = largest(path.throughput) / path.growth;
  if (vertex.bounce >= certain_bounces && survival < 1) {
    if (!(sampler_(vertex.sample, pair_of(vertex.bounce, roulette)).u < survival)) return;
    path.throughput = path.throughput * (1 / survival);
  }
  if (!(largest(path.throughput) > 0)) return;
  // Going straight through is as if there had been no surface.
  if (!drawn->is_unbent) {
    path.vertex = hit.point;
    path.density = drawn->density;
    path.is_camera_ray = false;
    path.is_sharp &= drawn->density == 0;
  }
  RayQuery query;
  query.ray = {hit.point, vertex.frame.to_world(drawn->direction)};
  query.kind = drawn->density > 0 ? RayKind::diffuse : drawn->is_transmitted ? RayKind::refracted : RayKind::reflected;
  query.from = &hit;
  next_paths_.push_back(path);
  next_queries_.push_back(query);
}

void PathIntegrator::trace_shadow_rays(std::span<Rgb> light, TraceContext& context) {
  if (scene_.has_unbent()) {
    for (std::size_t i = 0; i < shadow_queries_.size(); ++i) {
      const ShadowRay& ray = shadow_rays_[i];
      light[ray.slot] += ray.light * transmittance(shadow_queries_[i], ray.medium, context);
    }
  } else {
    occluded_.resize(shadow_queries_.size());
    accelerator_.occluded(shadow_queries_, occluded_, context);
    for (std::size_t i = 0; i < occluded_.size(); ++i) {
      if (occluded_[i] != 0) continue;
      const ShadowRay& ray = shadow_rays_[i];
      const double distance = shadow_queries_[i].t_max * length(shadow_queries_[i].ray.direction);
      light[ray.slot] += ray.light * scene_.attenuation(ray.medium, distance);
    }
  }
  shadow_queries_.clear();
  shadow_rays_.clear();
}

Rgb PathIntegrator::transmittance(const RayQuery& query, MediumId medium, TraceContext& context) {
  passed_.clear();
  const auto stops = [this](const Hit& hit) {
    const Rgb share = scene_.surface(hit.material).unbent(scene_.color(hit), scene_.boundary(hit));
    if (share == Rgb{}) return true;
    passed_.add(hit, share);
    return false;
  };
  if (accelerator_.any_hit(query, stops, context)) return {};
  return passed_.left(scene_, medium, length(query.ray.direction), query.t_max);
}

}  // namespace tenon
