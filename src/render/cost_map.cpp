#include "tenon/render/cost_map.h"

#include <algorithm>
#include <chrono>
#include <memory>

#include "render/tile_worker.h"
#include "render/tiles.h"
#include "tenon/base/parallel_for.h"

namespace tenon {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

// What was counted after `before`.
TraversalCounters since(const TraversalCounters& before, const TraversalCounters& now) {
  return {now.rays - before.rays, now.primitive_tests - before.primitive_tests,
          now.cells_visited - before.cells_visited, now.next_box_calls - before.next_box_calls,
          now.mailbox_hits - before.mailbox_hits};
}
TraversalStatistics since(const TraversalStatistics& before, const TraversalStatistics& now) {
  TraversalStatistics cost;
  for (std::size_t i = 0; i < ray_kind_count; ++i) cost.by_kind[i] = since(before.by_kind[i], now.by_kind[i]);
  cost.seam_faults = now.seam_faults - before.seam_faults;
  return cost;
}

// One thread's part of the work.
class PixelMeter {
 public:
  PixelMeter(const LitScene& lit, const Accelerator& accelerator, const CameraRays& camera,
             const RenderOptions& options, int takes)
      : worker_(lit, nullptr, nullptr, accelerator, camera, options), options_(options), takes_(takes) {}

  void take(int x, int y, CostMap& map) {
    const std::size_t i = map.window.index(x, y);
    const TraversalStatistics before = worker_.statistics();
    map.seconds[i] = timed_take(x, y);
    const TraversalStatistics cost = since(before, worker_.statistics());
    const TraversalCounters total = cost.total();
    map.primitive_tests[i] = static_cast<double>(total.primitive_tests);
    map.cells_visited[i] = static_cast<double>(total.cells_visited);
    statistics_ += cost;
    for (int again = 1; again < takes_; ++again) map.seconds[i] = std::min(map.seconds[i], timed_take(x, y));
  }

  const TraversalStatistics& statistics() const { return statistics_; }

 private:
  double timed_take(int x, int y) {
    const PixelWindow pixel{x, y, x + 1, y + 1};
    Film colour(options_.width, options_.height, pixel, {});
    const auto begun = Clock::now();
    worker_.take(pixel, options_.first_sample, options_.end_sample.value_or(options_.samples), colour);
    return seconds_since(begun);
  }

  TileWorker worker_;
  const RenderOptions& options_;
  int takes_;
  TraversalStatistics statistics_;
};

}  // namespace

Result<CostMap> measure_cost(const Scene& scene, const Accelerator& accelerator, const RenderOptions& options,
                             int takes, ProgressCounters* progress) {
  const auto begun = Clock::now();
  const Result<CameraRays> camera = CameraRays::create(scene.camera, options.width, options.height);
  if (!camera) return camera.error();
  const LitScene lit(scene);
  CostMap map;
  map.window = options.crop.value_or(PixelWindow{0, 0, options.width, options.height});
  for (std::vector<double>* values : {&map.primitive_tests, &map.cells_visited, &map.seconds}) {
    values->resize(map.window.pixels());
  }
  const TileGrid tiles(map.window);
  const int wanted = options.threads > 0 ? options.threads : available_threads();
  map.threads = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(wanted), tiles.size()));
  std::vector<std::unique_ptr<PixelMeter>> meters;
  for (int i = 0; i < map.threads; ++i) {
    meters.push_back(std::make_unique<PixelMeter>(lit, accelerator, *camera, options, takes));
  }
  if (progress != nullptr) progress->total += map.window.pixels();
  parallel_for(tiles.size(), map.threads, [&](std::size_t i, int number) {
    const PixelWindow tile = tiles[i];
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) meters[static_cast<std::size_t>(number)]->take(x, y, map);
    }
    if (progress != nullptr) progress->done += tile.pixels();
  });
  for (const auto& meter : meters) map.statistics += meter->statistics();
  map.render_seconds = seconds_since(begun);
  return map;
}

}  // namespace tenon
