#include "lab/race.h"

#include <algorithm>
#include <cmath>

namespace tenon {

namespace {

// Building goes on in rounds where it takes less than this.
constexpr double quick_build_seconds = 0.3;

struct Racer {
  std::unique_ptr<Accelerator> accelerator;
  Film picture;
};

Status build_once(const Contender& contender, Racer& racer, Timing& timing) {
  Result<std::unique_ptr<Accelerator>> built = Error{};
  timing.seconds.push_back(cpu_seconds([&] {
    built = build_accelerator(contender.accelerator, *contender.scene->scene.tree, &contender.scene->camera.view());
  }));
  if (!built) return built.error();
  racer.accelerator = std::move(*built);
  return success();
}

std::size_t count_different_pixels(const Film& a, const Film& b) {
  std::size_t count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) count += a.light(x, y) == b.light(x, y) ? 0 : 1;
  }
  return count;
}

}  // namespace

int race_steps(const Lab& lab, std::size_t contenders, int rounds) {
  return static_cast<int>(contenders) * ((rounds > 0 ? rounds : lab.effort().rounds) + 1);
}

Result<std::vector<RaceResult>> race(Lab& lab, const std::vector<Contender>& contenders, RenderOptions options,
                                     int rounds) {
  if (rounds == 0) rounds = lab.effort().rounds;
  options.threads = 1;
  std::vector<RaceResult> results;
  std::vector<Racer> racers(contenders.size());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    names.push_back(contenders[i].name);
    RaceResult result{contenders[i].name, {contenders[i].name, {}}, {}, {}, {}, 0};
    if (Status status = build_once(contenders[i], racers[i], result.build); !status) return status.error();
    result.figures = racers[i].accelerator->figures();
    results.push_back(std::move(result));
  }
  for (int round = 1; round < rounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      if (results[i].build.seconds.front() > quick_build_seconds) continue;
      Racer rebuilt;
      if (Status status = build_once(contenders[i], rebuilt, results[i].build); !status) return status.error();
    }
  }
  std::optional<Error> failed;
  const std::vector<Timing> timings = take_turns(names, rounds, [&](std::size_t i) {
    const ScreenView& view = contenders[i].scene->camera.view();
    options.width = view.width;
    options.height = view.height;
    Result<Rendering> rendering = render(contenders[i].scene->scene, *racers[i].accelerator, options);
    lab.step();
    if (!rendering) {
      failed = rendering.error();
      return 0.0;
    }
    results[i].statistics = rendering->statistics;
    racers[i].picture = std::move(rendering->film);
    return rendering->cpu_seconds;
  });
  if (failed) return *failed;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    results[i].render = timings[i];
    results[i].different_pixels = count_different_pixels(racers.front().picture, racers[i].picture);
  }
  return results;
}

Measured speedup(const RaceResult& slow, const RaceResult& fast) {
  Timing ratios{"", {}};
  for (std::size_t i = 0; i < slow.render.seconds.size(); ++i) {
    ratios.seconds.push_back(slow.render.seconds[i] / fast.render.seconds[i]);
  }
  return {ratios.median(), ratios.spread()};
}

LabFigure speedup_figure(const RaceResult& slow, const RaceResult& fast) {
  const Measured measured = speedup(slow, fast);
  return {measured.value, measured.spread, ""};
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
