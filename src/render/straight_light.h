#pragma once

#include <array>
#include <numeric>
#include <span>
#include <vector>

#include "render/lit_scene.h"
#include "render/passed_boundaries.h"
#include "tenon/accel/accelerator.h"

namespace tenon {

/// How much of their light shadow rays bring where some boundaries let light go straight on. One for each thread: it
/// keeps scratch memory.
class StraightLight {
 public:
  StraightLight(const LitScene& scene, const Accelerator& accelerator) : scene_(scene), accelerator_(accelerator) {}

  /// @param queries      their shadow rays
  /// @param start        start(i) is the medium where ray i begins
  /// @param let_through  let_through(boundary, query) is the share that a boundary lets straight on
  /// @return the share of each, until the next call
  template <class Start, class LetThrough>
  std::span<const Rgb> shares(std::span<const RayQuery> queries, const Start& start, const LetThrough& let_through,
                              TraceContext& context) {
    shares_.assign(queries.size(), {1, 1, 1});
    media_.clear();
    for (std::size_t i = 0; i < queries.size(); ++i) media_.push_back(start(i));
    numbers_.resize(queries.size());
    std::iota(numbers_.begin(), numbers_.end(), 0);
    // Most rays meet nothing, or what is opaque. The others go on together from what they met, for structures trace
    // many rays faster than one. One that still has not ended is asked for all of its boundaries.
    const std::size_t most_waves = accelerator_.answers_piecewise() ? 16 : 1;
    std::span<const RayQuery> rays = queries;
    for (std::size_t wave = 0; wave < most_waves && !rays.empty(); ++wave) {
      std::vector<Hit>& hits = hits_[wave % 2];
      hits.resize(rays.size());
      accelerator_.first_hits(rays, hits, context);
      std::vector<RayQuery>& next = next_[wave % 2];
      next.clear();
      std::size_t going_on = 0;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::uint32_t number = numbers_[i];
        if (!pass(rays[i], hits[i], let_through, number)) continue;
        next.push_back(behind(rays[i], hits[i]));
        numbers_[going_on++] = number;
      }
      numbers_.resize(going_on);
      rays = next;
    }
    for (const std::uint32_t number : numbers_) {
      shares_[number] = share_behind_all(queries[number], start(number), let_through, context);
    }
    return shares_;
  }

 private:
  // Takes the light past what a ray has met, or to its end. @return whether it goes on
  template <class LetThrough>
  bool pass(const RayQuery& query, const Hit& hit, const LetThrough& let_through, std::uint32_t number) {
    Rgb& share = shares_[number];
    const double length_per_unit = length(query.ray.direction);
    if (!hit.found()) {
      share = share * scene_.attenuation(media_[number], query.t_max * length_per_unit);
      return false;
    }
    share = let_through(hit, query) * share;
    if (share == Rgb{}) return false;
    share = share * scene_.attenuation(hit.before, hit.t * length_per_unit);
    media_[number] = hit.after;
    return true;
  }

  static RayQuery behind(const RayQuery& query, const Hit& hit) {
    RayQuery rest = query;
    rest.ray.origin = hit.point;
    rest.t_max = query.t_max - hit.t;
    rest.from = &hit;
    return rest;
  }

  template <class LetThrough>
  Rgb share_behind_all(const RayQuery& query, MediumId start, const LetThrough& let_through, TraceContext& context) {
    passed_.clear();
    const auto stops = [&](const Hit& boundary) {
      const Rgb share = let_through(boundary, query);
      if (share == Rgb{}) return true;
      passed_.add(boundary, share);
      return false;
    };
    if (accelerator_.any_hit(query, stops, context)) return {};
    return passed_.left(scene_, start, length(query.ray.direction), query.t_max);
  }

  const LitScene& scene_;
  const Accelerator& accelerator_;
  std::vector<Rgb> shares_;
  std::vector<MediumId> media_;         // where each ray has come to
  std::vector<std::uint32_t> numbers_;  // of the rays that have not ended
  // Of a wave and of the one before it, where its rays begin.
  std::array<std::vector<Hit>, 2> hits_;
  std::array<std::vector<RayQuery>, 2> next_;
  PassedBoundaries passed_;
};

}  // namespace tenon
