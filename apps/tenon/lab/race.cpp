#include "lab/race.h"

#include <algorithm>
#include <cmath>

namespace tenon {

namespace {

// Building goes on in rounds where it takes less than this.
constexpr double quick_build_seconds = 0.3;

Result<std::unique_ptr<Accelerator>> build_once(const Contender& contender, Timing& timing) {
  Result<std::unique_ptr<Accelerator>> built = Error{};
  timing.seconds.push_back(cpu_seconds([&] {
    built = build_accelerator(contender.accelerator, *contender.scene->scene.tree, &contender.scene->camera.view());
  }));
  return built;
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

}  // namespace

int race_steps(const Lab& lab, std::size_t contenders, int rounds) {
  return static_cast<int>(contenders) * ((rounds > 0 ? rounds : lab.effort().rounds) + 1);
}

Result<std::vector<RaceResult>> race(Lab& lab, const std::vector<Contender>& contenders, RenderOptions options,
                                     int rounds) {
  if (rounds == 0) rounds = lab.effort().rounds;
  options.threads = 1;
  std::vector<RaceResult> results;
  std::vector<std::unique_ptr<Accelerator>> accelerators;
  std::vector<std::string> names;
  for (const Contender& contender : contenders) {
    names.push_back(contender.name);
    RaceResult result;
    result.name = contender.name;
    result.primitives = scene_figures(contender.scene->scene).primitives;
    Result<std::unique_ptr<Accelerator>> built = build_once(contender, result.build);
    if (!built) return built.error();
    result.figures = (*built)->figures();
    accelerators.push_back(std::move(*built));
    results.push_back(std::move(result));
  }
  for (int round = 1; round < rounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      if (results[i].build.seconds.front() > quick_build_seconds) continue;
      if (const auto built = build_once(contenders[i], results[i].build); !built) return built.error();
    }
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
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    results[i].render = timings[i];
    if (contenders[i].is_approximate) continue;
    results[i].different_pixels = count_different_pixels(results.front().picture, results[i].picture, 0);
  }
  return results;
}

void note_differences(const std::vector<RaceResult>& results, LabTable& table) {
  for (const RaceResult& r : results) {
    if (r.different_pixels == 0) continue;
    table.notes.push_back(r.name + " took another picture: " + std::to_string(r.different_pixels) + " pixels differ.");
  }
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
