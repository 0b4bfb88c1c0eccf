#include "lab/race.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tenon {

namespace {

// Building goes on in rounds where it takes less than this.
constexpr double quick_build_seconds = 0.3;
// What takes less than this is built again and again until it is over: a clock and cold caches are off by microseconds.
constexpr double shortest_round_seconds = 0.005;

Result<std::unique_ptr<Accelerator>> build(const Contender& contender) {
  return build_accelerator(contender.accelerator, *contender.scene->scene.tree, &contender.scene->camera.view());
}

double time_building(const Contender& contender) {
  double seconds = 0;
  int built = 0;
  for (; seconds < shortest_round_seconds; ++built) {
    seconds += cpu_seconds([&] { static_cast<void>(build(contender)); });
  }
  return seconds / built;
}

std::size_t count_different_pixels(const Film& a, const Film& b, double tolerance) {
  std::size_t count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const Rgb p = a.light(x, y), q = b.light(x, y);
      const double off = std::max({std::fabs(p.r - q.r), std::fabs(p.g - q.g), std::fabs(p.b - q.b)});
      count += off > tolerance ? 1 : 0;
    }
  }
  return count;
}

int rounds_of(const Lab& lab, int rounds) {
  return rounds > 0 ? rounds : lab.effort().rounds;
}

// With all structures in memory.
Result<std::vector<RaceResult>> race_together(Lab& lab, std::span<const Contender> contenders, const RaceRules& rules) {
  RenderOptions options = rules.options;
  options.threads = rules.threads;
  const int rounds = rounds_of(lab, rules.rounds);
  std::vector<RaceResult> results;
  std::vector<std::unique_ptr<Accelerator>> accelerators;
  std::vector<std::string> names;
  for (const Contender& contender : contenders) {
    names.push_back(contender.name);
    RaceResult result;
    result.name = contender.name;
    result.primitives = scene_figures(contender.scene->scene).primitives;
    Result<std::unique_ptr<Accelerator>> built = Error{};
    result.build.seconds = {cpu_seconds([&] { built = build(contender); })};
    if (!built) return built.error();
    result.figures = (*built)->figures();
    accelerators.push_back(std::move(*built));
    results.push_back(std::move(result));
  }
  std::vector<std::size_t> quick;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].build.seconds.front() > quick_build_seconds) continue;
    results[i].build.seconds.clear();
    quick.push_back(i);
  }
  for (int round = 0; round < rounds; ++round) {
    for (const std::size_t i : quick) results[i].build.seconds.push_back(time_building(contenders[i]));
  }
  std::optional<Error> failed;
  const std::vector<Timing> timings = take_turns(names, rounds, [&](std::size_t i) {
    const ScreenView& view = contenders[i].scene->camera.view();
    options.width = view.width;
    options.height = view.height;
    Result<Rendering> rendering = render(contenders[i].scene->scene, *accelerators[i], options);
    lab.step();
    if (!rendering) {
      failed = rendering.error();
      return 0.0;
    }
    results[i].statistics = rendering->statistics;
    results[i].picture = std::move(rendering->film);
    return rendering->cpu_seconds;
  });
  if (failed) return *failed;
  for (std::size_t i = 0; i < contenders.size(); ++i) results[i].render = timings[i];
  return results;
}

}  // namespace

std::vector<Contender> structures_over(const LabScene& scene, const std::vector<std::string>& accelerators) {
  std::vector<Contender> contenders;
  for (const std::string& a : accelerators) contenders.push_back({a, &scene, a});
  return contenders;
}

int race_steps(const Lab& lab, std::size_t contenders, int rounds) {
  return static_cast<int>(contenders) * (rounds_of(lab, rounds) + 1);
}

Result<std::vector<RaceResult>> race(Lab& lab, const std::vector<Contender>& contenders, const RaceRules& rules,
                                     LabTable& table) {
  const std::span<const Contender> all(contenders);
  const std::size_t at_once = rules.together ? all.size() : 1;
  std::vector<RaceResult> results;
  for (std::size_t begin = 0; begin < all.size(); begin += at_once) {
    auto part = race_together(lab, all.subspan(begin, at_once), rules);
    if (!part) return part.error();
    std::move(part->begin(), part->end(), std::back_inserter(results));
  }
  for (std::size_t i = 1; i < results.size(); ++i) {
    if (all[i].is_approximate) continue;
    const std::size_t different = count_different_pixels(results.front().picture, results[i].picture, 0);
    if (different == 0) continue;
    table.notes.push_back(results[i].name + " took another picture than " + results.front().name + ": " +
                          std::to_string(different) + " pixels differ.");
  }
  return results;
}

double share_of_different_pixels(const Film& a, const Film& b, double tolerance) {
  return static_cast<double>(count_different_pixels(a, b, tolerance)) / static_cast<double>(a.window().pixels());
}

Measured speedup(const RaceResult& slow, const RaceResult& fast) {
  Timing ratios{"", {}};
  for (std::size_t i = 0; i < slow.render.seconds.size(); ++i) {
    ratios.seconds.push_back(slow.render.seconds[i] / fast.render.seconds[i]);
  }
  return {ratios.median(), ratios.spread()};
}

std::optional<double> next_box_calls_a_ray(const TraversalStatistics& statistics, const std::vector<RayKind>& kinds) {
  TraversalCounters sum;
  for (const RayKind kind : kinds) sum += statistics[kind];
  if (sum.rays == 0) return std::nullopt;
  return static_cast<double>(sum.next_box_calls) / static_cast<double>(sum.rays);
}

double mailbox_share(const TraversalStatistics& statistics) {
  const TraversalCounters total = statistics.total();
  const double asked = static_cast<double>(total.primitive_tests + total.mailbox_hits);
  return asked > 0 ? static_cast<double>(total.mailbox_hits) / asked : 0;
}

}  // namespace tenon
