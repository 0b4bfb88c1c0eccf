#include "rays/sampled_race.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "rays/answers.h"
#include "rays/measure.h"

namespace tenon::bench {

namespace {

constexpr double longest_round = 0.1;  // in seconds
// One block of rays in so many.
constexpr std::array<std::size_t, 4> samples{1, 4, 16, 64};

// The multiples of the golden ratio lie evenly between whole numbers (Weyl 1916), so blocks that are chosen by them lie
// evenly over the picture, in no step with its rows.
bool is_in_sample(std::size_t block, std::size_t one_in) {
  const double turns = static_cast<double>(block) * std::numbers::phi;
  return (turns - std::floor(turns)) * static_cast<double>(one_in) < 1;
}

template <class Item>
std::vector<Item> take_sample(const std::vector<Item>& all, std::size_t one_in) {
  std::vector<Item> sample;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_in_sample(i / Tracer::block, one_in)) sample.push_back(all[i]);
  }
  return sample;
}

// The rays of a set, and samples of them.
class SampledRays {
 public:
  explicit SampledRays(const RaySet& set) : all_(set) {}

  const RaySet& one_in(std::size_t n) {
    if (n == 1) return all_;
    const auto [place, is_new] = samples_.try_emplace(n);
    if (is_new) place->second = {all_.kind, take_sample(all_.rays, n)};
    return place->second;
  }
  // How many rays there are for each of a sample.
  double rays_per_sampled(std::size_t n) {
    return static_cast<double>(all_.rays.size()) / static_cast<double>(one_in(n).rays.size());
  }

 private:
  const RaySet& all_;
  std::map<std::size_t, RaySet> samples_;
};

// The largest sample that a contender traces in time, as the smallest one lets expect; else the smallest.
std::size_t choose_sample(Tracer& tracer, SampledRays& rays) {
  constexpr std::size_t smallest = samples.back();
  trace_once(tracer, rays.one_in(smallest), 1);  // what is read for the first time takes longer
  const double seconds = trace_once(tracer, rays.one_in(smallest), 1) * rays.rays_per_sampled(smallest);
  for (const std::size_t n : samples) {
    if (seconds <= longest_round * rays.rays_per_sampled(n)) return n;
  }
  return smallest;
}

}  // namespace

SampledRace race_on_samples(std::span<const std::unique_ptr<Tracer>> tracers, const RaySet& set) {
  SampledRays rays(set);
  std::vector<std::string> names;
  std::vector<std::size_t> chosen;
  for (const auto& tracer : tracers) {
    names.push_back(tracer->name());
    // The first traces all of them.
    chosen.push_back(chosen.empty() ? 1 : choose_sample(*tracer, rays));
  }
  SampledRace race;
  std::map<std::size_t, double> whole_to_sample;  // of this round
  race.timings = take_turns(names, rounds, [&](std::size_t i) {
    if (i != 0) return trace_once(*tracers[i], rays.one_in(chosen[i]), 1) * whole_to_sample[chosen[i]];
    const double whole = trace_once(*tracers[i], set, 1);
    whole_to_sample = {{1, 1}};
    for (const std::size_t n : chosen) {
      if (!whole_to_sample.contains(n)) whole_to_sample[n] = whole / trace_once(*tracers[i], rays.one_in(n), 1);
    }
    return whole;
  });

  // The first has to say something of every ray.
  trace_once(*tracers.front(), set, 1);
  const std::vector<Answer> own = tracers.front()->answers();
  race.disagreements.push_back(0);
  for (std::size_t i = 1; i < tracers.size(); ++i) {
    race.disagreements.push_back(count_disagreements(take_sample(own, chosen[i]), tracers[i]->answers(), set.kind));
  }
  for (const auto& tracer : tracers) tracer->unload();
  return race;
}

}  // namespace tenon::bench
