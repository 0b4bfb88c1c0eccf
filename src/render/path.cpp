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

// Bounces that no path ends at by chance.
constexpr int certain_bounces = 3;

double largest(const Rgb& c) {
  return std::max({c.r, c.g, c.b});
}

}  // namespace

PathIntegrator::PathIntegrator(const LitScene& scene, const Accelerator& accelerator, const Sampler& sampler, int depth,
                               LightStrategy strategy)
    : scene_(scene),
      accelerator_(accelerator),
      sampler_(sampler),
      depth_(depth),
      strategy_(strategy),
      shadow_rays_(scene.lights().size()) {}

void PathIntegrator::radiance(std::span<const RayQuery> primary, std::span<const Hit> hits,
                              std::span<const SampleId> samples, std::span<Rgb> light, TraceContext& context) {
  std::fill(light.begin(), light.end(), Rgb{});
  paths_.assign(primary.size(), Path{});
  for (std::size_t i = 0; i < paths_.size(); ++i) paths_[i].slot = static_cast<std::uint32_t>(i);
  std::span<const RayQuery> rays = primary;
  for (int bounce = 0;; ++bounce) {
    next_paths_.clear();
    next_queries_.clear();
    vertices_.clear();
    for (std::uint32_t i = 0; i < paths_.size(); ++i) {
      Rgb& received = light[paths_[i].slot];
      if (meet(paths_[i], rays[i], hits[i], received)) vertices_.push_back({i, -rays[i].ray.direction});
    }
    draw(samples, bounce);
    for (std::size_t i = 0; i < vertices_.size(); ++i) scatter(i, hits[vertices_[i].path], bounce);
    trace_shadow_rays(light, context);
    if (next_paths_.empty()) return;
    // Hits are kept where there are fewer of them for now: to make them takes time.
    if (next_hits_.size() < next_queries_.size()) next_hits_.resize(next_queries_.size());
    const std::span<Hit> met = std::span(next_hits_).first(next_queries_.size());
    accelerator_.first_hits(next_queries_, met, context);
    // The queries point into the hits they start at, which live until the next bounce is traced.
    std::swap(paths_, next_paths_);
    std::swap(queries_, next_queries_);
    std::swap(hits_, next_hits_);
    rays = queries_;
    hits = met;
  }
}

// What comes from where the ray ends by itself. @return whether there is a surface for more to come from
bool PathIntegrator::meet(Path& path, const RayQuery& query, const Hit& hit, Rgb& light) const {
  const Vec3& d = query.ray.direction;
  const auto lamp = scene_.first_light(query.ray, hit.t);
  const MediumId medium = hit.found() ? hit.before : medium_outside;
  if (medium > medium_opaque)
    path.throughput = path.throughput * scene_.attenuation(medium, lamp ? lamp->second.t : hit.t);
  if (lamp) {
    const auto& [met, place] = *lamp;
    light += weight_of_met_light(path, *met, place.density) * (path.throughput * place.radiance);
    return false;
  }
  if (!hit.found()) {
    const LitLight* around = scene_.around();
    const double share = around == nullptr ? 1 : weight_of_met_light(path, *around, around->environment()->density(d));
    light += share * (path.throughput * scene_.beyond(d, path.is_camera_ray, path.is_sharp));
    return false;
  }
  light += path.throughput * scene_.emitted(hit);
  return true;
}

void PathIntegrator::draw(std::span<const SampleId> samples, int bounce) {
  samples_.clear();
  for (const Vertex& vertex : vertices_) samples_.push_back(samples[paths_[vertex.path].slot]);
  const auto draw_pairs = [&](BouncePair pair, std::vector<Sample2>& pairs) {
    pairs.resize(samples_.size());
    sampler_.draw(samples_, pair_of(bounce, pair), pairs);
  };
  draw_pairs(choices, draws_.choice);
  if (scene_.draws_places_of_lights()) draw_pairs(light_place, draws_.light_place);
  draw_pairs(direction, draws_.direction);
  if (bounce >= certain_bounces && bounce + 1 < depth_) draw_pairs(roulette, draws_.roulette);
}

void PathIntegrator::scatter(std::size_t vertex, const Hit& hit, int bounce) {
  const Vec3& to_viewer = vertices_[vertex].wo;
  const Frame frame(dot(hit.normal, to_viewer) < 0 ? -hit.normal : hit.normal);
  const Vec3 wo = frame.to_local(to_viewer);
  if (!(wo.z > 0)) return;  // along the surface, which then sends nothing that way
  const Bsdf bsdf = scene_.surface(hit.material).bsdf(wo, scene_.color(hit), scene_.boundary(hit));
  const Bounce at{paths_[vertices_[vertex].path], hit, frame, bsdf, vertex};
  if (bsdf.spreads()) connect(at);
  go_on(at, bounce);
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

void PathIntegrator::connect(const Bounce& at) {
  const Hit& hit = at.hit;
  const LightChoice chosen = scene_.choose_light(hit.point, draws_.choice[at.vertex].u);
  if (chosen.light == nullptr) return;
  const Sample2 place = chosen.light->has_extent() ? draws_.light_place[at.vertex] : Sample2{};
  const auto sample = chosen.light->sample(hit.point, place);
  if (!sample) return;
  const double distance = length(sample->to_light);
  const Vec3 wi = at.frame.to_local(sample->to_light / distance);
  const BsdfValue value = at.bsdf.evaluate(wi);
  double share = 1 / chosen.probability;
  if (sample->density > 0) {
    if (strategy_ == LightStrategy::bsdf) return;
    if (strategy_ == LightStrategy::both) share *= weight(sample->density * chosen.probability, value.density);
  }
  const Rgb sent = share * (at.path.throughput * value.light * sample->light);
  if (!(largest(sent) > 0)) return;
  double t_max = sample->t_max;
  if (chosen.light->has_surface()) t_max -= scene_.light_margin(sample->cos) / distance;
  if (scene_.is_blocked_by_light({hit.point, sample->to_light}, t_max, chosen.light)) return;
  // Part by part, where they stay: a copy of what was just put together waits for all of its parts.
  ShadowRays& to_light = shadow_rays_[static_cast<std::size_t>(chosen.light - scene_.lights().data())];
  RayQuery& query = to_light.queries.emplace_back();
  query.ray.origin = hit.point;
  query.ray.direction = sample->to_light;
  query.t_max = t_max;
  query.kind = RayKind::shadow;
  query.from = &hit;
  ShadowRay& ray = to_light.rays.emplace_back();
  ray.light = sent;
  ray.slot = at.path.slot;
  ray.medium = wi.z > 0 ? hit.before : hit.after;
}

void PathIntegrator::go_on(const Bounce& at, int bounce) {
  const auto drawn = at.bsdf.sample(draws_.choice[at.vertex].v, draws_.direction[at.vertex]);
  if (!drawn) return;
  const Hit& hit = at.hit;
  Rgb throughput = at.path.throughput * drawn->weight;
  double growth = at.path.growth;
  if (drawn->is_transmitted) {
    const double eta = scene_.ior(hit.before) / scene_.ior(hit.after);
    growth *= eta * eta;
  }
  // A path that carries little goes on seldom, and then carries more.
  const double survival = largest(throughput) / growth;
  if (bounce + 1 == depth_) {
    cut_ += {survival > 0 ? 1U : 0U, survival};
    return;
  }
  if (bounce >= certain_bounces && survival < 1) {
    if (!(draws_.roulette[at.vertex].u < survival)) return;
    throughput = throughput * (1 / survival);
  }
  if (!(largest(throughput) > 0)) return;
  Path& path = next_paths_.emplace_back(at.path);
  path.throughput = throughput;
  path.growth = growth;
  // Going straight through is as if there had been no surface.
  if (!drawn->is_unbent) {
    path.vertex = hit.point;
    path.density = drawn->density;
    path.is_camera_ray = false;
    path.is_sharp &= drawn->density == 0;
  }
  RayQuery& query = next_queries_.emplace_back();
  query.ray.origin = hit.point;
  query.ray.direction = at.frame.to_world(drawn->direction);
  query.kind = drawn->density > 0 ? RayKind::diffuse : drawn->is_transmitted ? RayKind::refracted : RayKind::reflected;
  query.from = &hit;
}

void PathIntegrator::trace_shadow_rays(std::span<Rgb> light, TraceContext& context) {
  for (ShadowRays& to_light : shadow_rays_) {
    const auto& [queries, rays] = to_light;
    if (scene_.has_unbent()) {
      for (std::size_t i = 0; i < queries.size(); ++i) {
        light[rays[i].slot] += rays[i].light * transmittance(queries[i], rays[i].medium, context);
      }
    } else if (!queries.empty()) {
      occluded_.resize(queries.size());
      accelerator_.occluded(queries, occluded_, context);
      for (std::size_t i = 0; i < queries.size(); ++i) {
        if (occluded_[i] != 0) continue;
        const double distance = queries[i].t_max * length(queries[i].ray.direction);
        light[rays[i].slot] += rays[i].light * scene_.attenuation(rays[i].medium, distance);
      }
    }
    to_light.queries.clear();
    to_light.rays.clear();
  }
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
