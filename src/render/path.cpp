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
      shadow_rays_(scene.lights().size()),
      straight_light_(scene, accelerator) {}

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
      if (meet(paths_[i], rays[i], hits[i], received)) vertices_.push_back(i);
    }
    draw(samples, bounce);
    for (std::uint32_t i = 0; i < vertices_.size(); ++i) groups_.add(hits[vertices_[i]], i);
    groups_.take_blocks([&](std::span<const std::uint32_t> block) { scatter(block, rays, hits, bounce); });
    trace_shadow_rays(light, context);
    note_light(bounce, light);
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

// Only where paths are long; there few are left, and to add up takes no time beside tracing them.
void PathIntegrator::note_light(int bounce, std::span<const Rgb> light) {
  const int quarter = depth_ / 4;
  const bool is_over = next_paths_.empty();
  if (!is_over && bounce + 1 < depth_ - 2 * quarter) return;
  double sum = 0;
  for (const Rgb& l : light) sum += (l.r + l.g + l.b) / 3;
  if (is_over) cut_.light += sum;
  if (bounce >= depth_ - quarter) {
    cut_.late_light += sum - noted_light_;
  } else if (bounce >= depth_ - 2 * quarter) {
    cut_.earlier_light += sum - noted_light_;
  }
  noted_light_ = sum;
}

// What comes from where the ray ends by itself. @return whether there is a surface for more to come from
bool PathIntegrator::meet(Path& path, const RayQuery& query, const Hit& hit, Rgb& light) const {
  const Vec3& d = query.ray.direction;
  const auto lamp = scene_.first_light(query.ray, hit.t);
  const MediumId medium = hit.found() ? hit.before : medium_outside;
  if (medium > medium_opaque) {
    path.throughput = path.throughput * scene_.attenuation(medium, lamp ? lamp->second.t : hit.t);
  }
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
  if (const Rgb emitted = scene_.emitted(hit); emitted != Rgb{}) light += path.throughput * emitted;
  return true;
}

void PathIntegrator::draw(std::span<const SampleId> samples, int bounce) {
  samples_.clear();
  for (const std::uint32_t vertex : vertices_) samples_.push_back(samples[paths_[vertex].slot]);
  const auto draw_pairs = [&](BouncePair pair, std::vector<Sample2>& pairs) {
    pairs.resize(samples_.size());
    sampler_.draw(samples_, pair_of(bounce, pair), pairs);
  };
  draw_pairs(choices, draws_.choice);
  if (scene_.draws_places_of_lights()) draw_pairs(light_place, draws_.light_place);
  draw_pairs(direction, draws_.direction);
  if (bounce >= certain_bounces && bounce + 1 < depth_) draw_pairs(roulette, draws_.roulette);
}

// @param vertices  of one material, between the same media
void PathIntegrator::scatter(std::span<const std::uint32_t> vertices, std::span<const RayQuery> rays,
                             std::span<const Hit> hits, int bounce) {
  block_.vertices = vertices;
  const std::size_t count = vertices.size();
  const auto hit = [&](std::size_t i) -> const Hit& { return hits[vertices_[vertices[i]]]; };
  for (std::size_t i = 0; i < count; ++i) {
    block_.normal.set(i, hit(i).normal);
    block_.direction.set(i, rays[vertices_[vertices[i]]].ray.direction);
    block_.color.set(i, scene_.color(hit(i)));
  }
  block_.frames.find(block_.normal, block_.direction, count, block_.wo);
  const Surface& surface = scene_.surface(hit(0).material);
  surface.scatter(block_.wo, block_.color, scene_.boundary(hit(0)), count, bsdf_);
  // Along the surface, which then sends nothing that way, wo.z is not above 0.
  if (bsdf_.spreads()) {
    for (std::size_t i = 0; i < count; ++i) draw_light(i, hit(i));
    block_.frames.to_local(block_.to_light, block_.wi);
    bsdf_.evaluate(block_.wi, block_.to_viewer);
    for (std::size_t i = 0; i < count; ++i) {
      if (block_.wo.z[i] > 0) connect(i, hit(i));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    block_.choice[i] = draws_.choice[vertices[i]].v;
    block_.place.set(i, draws_.direction[vertices[i]]);
  }
  bsdf_.sample(block_.choice, block_.place, block_.samples);
  block_.frames.to_world(block_.samples.direction, block_.next_direction);
  for (std::size_t i = 0; i < count; ++i) {
    if (block_.wo.z[i] > 0) go_on(i, hit(i), bounce);
  }
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

void PathIntegrator::draw_light(std::size_t i, const Hit& hit) {
  DrawnLight& drawn = block_.lights[i];
  const std::uint32_t vertex = block_.vertices[i];
  const LightChoice chosen = scene_.choose_light(hit.point, draws_.choice[vertex].u);
  drawn.light = nullptr;
  if (chosen.light == nullptr) return;
  const Sample2 place = chosen.light->has_extent() ? draws_.light_place[vertex] : Sample2{};
  if (!chosen.light->draw(hit.point, place, drawn.sample)) return;
  drawn.light = chosen.light;
  drawn.probability = chosen.probability;
  block_.to_light.set(i, drawn.sample.to_light);
}

void PathIntegrator::connect(std::size_t i, const Hit& hit) {
  const auto& [light, probability, sample] = block_.lights[i];
  if (light == nullptr) return;
  const Path& path = paths_[vertices_[block_.vertices[i]]];
  double share = 1 / probability;
  if (sample.density > 0) {
    if (strategy_ == LightStrategy::bsdf) return;
    if (strategy_ == LightStrategy::both) share *= weight(sample.density * probability, block_.to_viewer.density[i]);
  }
  const Rgb sent = share * (path.throughput * block_.to_viewer.light[i] * sample.light);
  if (!(largest(sent) > 0)) return;
  double t_max = sample.t_max;
  if (light->has_surface()) t_max -= scene_.light_margin(sample.cos) / length(sample.to_light);
  if (scene_.is_blocked_by_light({hit.point, sample.to_light}, t_max, light)) return;
  // Part by part, where they stay: a copy of what was just put together waits for all of its parts.
  ShadowRays& to_light = shadow_rays_[static_cast<std::size_t>(light - scene_.lights().data())];
  RayQuery& query = to_light.queries.emplace_back();
  query.ray.origin = hit.point;
  query.ray.direction = sample.to_light;
  query.t_max = t_max;
  query.kind = RayKind::shadow;
  query.from = &hit;
  ShadowRay& ray = to_light.rays.emplace_back();
  ray.light = sent;
  ray.slot = path.slot;
  ray.medium = block_.wi.z[i] > 0 ? hit.before : hit.after;
}

void PathIntegrator::go_on(std::size_t i, const Hit& hit, int bounce) {
  const BsdfSamples& drawn = block_.samples;
  const Path& from = paths_[vertices_[block_.vertices[i]]];
  const bool is_transmitted = drawn.is_transmitted(i);
  Rgb throughput = from.throughput * drawn.weight[i];
  double growth = from.growth;
  if (is_transmitted) {
    const double eta = scene_.ior(hit.before) / scene_.ior(hit.after);
    growth *= eta * eta;
  }
  // A path that carries little goes on seldom, and then carries more.
  if (bounce + 1 == depth_) {
    const double survival = largest(throughput) / growth;
    cut_.paths += survival > 0 ? 1 : 0;
    cut_.throughput += survival;
    return;
  }
  if (bounce >= certain_bounces) {
    const double survival = std::min(1.0, largest(throughput) / growth);
    if (!(draws_.roulette[block_.vertices[i]].u < survival)) return;
    throughput = throughput * (1 / survival);
  }
  if (!(largest(throughput) > 0)) return;
  const double density = drawn.density[i];
  Path& path = next_paths_.emplace_back(from);
  path.throughput = throughput;
  path.growth = growth;
  // Going straight through is as if there had been no surface.
  if (drawn.is_unbent[i] == 0) {
    path.vertex = hit.point;
    path.density = density;
    path.is_camera_ray = false;
    path.is_sharp &= density == 0;
  }
  RayQuery& query = next_queries_.emplace_back();
  query.ray.origin = hit.point;
  query.ray.direction = block_.next_direction[i];
  query.kind = density > 0 ? RayKind::diffuse : is_transmitted ? RayKind::refracted : RayKind::reflected;
  query.from = &hit;
}

void PathIntegrator::trace_shadow_rays(std::span<Rgb> light, TraceContext& context) {
  for (ShadowRays& to_light : shadow_rays_) {
    const auto& [queries, rays] = to_light;
    if (scene_.has_unbent() && !queries.empty()) {
      const auto start = [&to_light](std::size_t i) { return to_light.rays[i].medium; };
      const auto let_through = [this](const Hit& boundary, const RayQuery&) {
        return scene_.surface(boundary.material).unbent(scene_.color(boundary), scene_.boundary(boundary));
      };
      const std::span<const Rgb> shares = straight_light_.shares(queries, start, let_through, context);
      for (std::size_t i = 0; i < queries.size(); ++i) light[rays[i].slot] += rays[i].light * shares[i];
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

}  // namespace tenon
