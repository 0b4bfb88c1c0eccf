#include "tenon/render/renderer.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <memory>
#include <numeric>

#include "render/noise.h"
#include "render/tile_cut.h"
#include "render/tile_worker.h"
#include "render/tiles.h"
#include "tenon/base/parallel_for.h"
#include "tenon/base/timing.h"

namespace tenon {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

/// Takes the samples of a film, in rounds over its tiles.
class FilmWork {
 public:
  FilmWork(const RenderOptions& options, const RenderControl& control, Film& film)
      : options_(options),
        control_(control),
        film_(film),
        tiles_(film.window()),
        first_(options.first_sample),
        end_(options.end_sample.value_or(options.samples)) {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const PixelWindow tile = tiles_[i];
      const std::uint32_t taken = film.samples(tile.x0, tile.y0);
      reached_.push_back(first_ + taken);
      settled_.push_back(0);
      expected_.push_back(0);
      cut_.push_back({tile, 0, {}});
      look_ahead(i);
      if (control.progress != nullptr) control.progress->before += tile.pixels() * taken;
    }
    if (control.progress == nullptr) return;
    control.progress->done = control.progress->before.load();
    control.progress->seconds_allowed = options.seconds;
  }

  std::size_t tiles() const { return tiles_.size(); }

  /// @return how the work ended
  RenderEnd run(std::vector<std::unique_ptr<TileWorker>>& workers) {
    busy_seconds_.resize(workers.size());
    for (;;) {
      const std::vector<std::size_t> round = next_round();
      if (round.empty()) return RenderEnd::finished;
      std::atomic<bool> halted{false};
      parallel_for(round.size(), static_cast<int>(workers.size()), [&](std::size_t i, int number) {
        if (halted || wants_break()) halted = true;
        const auto worker = static_cast<std::size_t>(number);
        if (!halted) advance(round[i], *workers[worker], busy_seconds_[worker]);
      });
      if (is_interrupted()) return RenderEnd::interrupted;
      if (is_out_of_time()) return RenderEnd::out_of_time;
      if (!is_checkpoint_due()) continue;
      control_.checkpoint(film_, done());
      checkpoint_ = Clock::now();
    }
  }

  double busy_seconds() const { return std::accumulate(busy_seconds_.begin(), busy_seconds_.end(), 0.0); }

  DepthCut cut() const { return depth_cut(cut_); }

  std::vector<SampleBox> done() const {
    std::vector<SampleBox> boxes;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const std::uint32_t reached = settled_[i] ? end_ : reached_[i];
      if (reached > first_) boxes.push_back({tiles_[i], first_, reached});
    }
    return joined(std::move(boxes));
  }

 private:
  // The first rounds double the samples. Later ones are short enough for a tile not to keep an end waiting.
  std::uint32_t round_end(std::uint32_t reached) const {
    constexpr std::uint32_t longest = 16;
    const std::uint32_t taken = reached - first_;
    const std::uint32_t more = taken == 0 ? 1 : std::min(taken, longest - taken % longest);
    return std::min(end_, reached + more);
  }

  // The tiles that are furthest behind; none when all are done.
  std::vector<std::size_t> next_round() {
    least_ = end_;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (!settled_[i]) least_ = std::min(least_, reached_[i]);
    }
    std::vector<std::size_t> round;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      if (!settled_[i] && reached_[i] == least_) round.push_back(i);
    }
    return round;
  }

  void advance(std::size_t i, TileWorker& worker, double& busy_seconds) {
    const double begun = thread_cpu_seconds();
    const PixelWindow tile = tiles_[i];
    const std::uint32_t end = round_end(reached_[i]);
    const std::uint64_t rays_before = worker.statistics().total().rays;
    cut_[i].paths += worker.take(tile, reached_[i], end, film_);
    cut_[i].samples += tile.pixels() * (end - reached_[i]);
    busy_seconds += thread_cpu_seconds() - begun;
    const std::uint64_t done = tile.pixels() * (end - reached_[i]);
    reached_[i] = end;
    look_ahead(i);
    if (control_.progress == nullptr) return;
    control_.progress->done += done;
    control_.progress->rays += worker.statistics().total().rays - rays_before;
  }

  // Whether a tile needs more samples, and how many it will have in the end. The first follows from the tile's own
  // samples alone, so that parts of a picture agree, and so does work that is taken up again: tiles are only ever left
  // at the end of a round. The second is for those who wait: errors fall with the root of the samples' number.
  void look_ahead(std::size_t i) {
    const std::uint32_t taken = reached_[i] - first_, before = expected_[i];
    settled_[i] = reached_[i] == end_;
    expected_[i] = end_ - first_;
    if (!settled_[i] && options_.noise > 0 && taken > 1) {
      const double share = noise(film_, tiles_[i]) / options_.noise;
      settled_[i] = taken >= least_samples_for_noise && share <= 1;
      const double more = std::max({taken + 1.0, static_cast<double>(least_samples_for_noise), taken * share * share});
      expected_[i] = settled_[i] ? taken : static_cast<std::uint32_t>(std::min<double>(more, expected_[i]));
    }
    // Less than before is more by a turn of the unsigned numbers.
    if (control_.progress != nullptr)
      control_.progress->total += tiles_[i].pixels() * (std::uint64_t{expected_[i]} - before);
  }

  bool is_interrupted() const { return control_.interrupted && control_.interrupted(); }
  // A picture without any sample in some of its pixels is of no use to anybody.
  bool is_out_of_time() const {
    return options_.seconds > 0 && least_ > first_ && seconds_since(begun_) >= options_.seconds;
  }
  bool is_checkpoint_due() const {
    return control_.checkpoint && seconds_since(checkpoint_) >= control_.checkpoint_seconds;
  }
  bool wants_break() const { return is_interrupted() || is_out_of_time() || is_checkpoint_due(); }

  const RenderOptions& options_;
  const RenderControl& control_;
  Film& film_;
  TileGrid tiles_;
  std::uint32_t first_, end_;
  std::vector<std::uint32_t> reached_;   // by tile: the first sample that is not taken
  std::vector<char> settled_;            // by tile: it needs no more samples
  std::vector<std::uint32_t> expected_;  // by tile: samples from first_ on that it will have
  std::uint32_t least_ = 0;              // where the round began
  std::vector<TileCut> cut_;             // by tile
  std::vector<double> busy_seconds_;     // by worker: CPU time of taking samples
  Clock::time_point begun_ = Clock::now(), checkpoint_ = begun_;
};

bool shows_surfaces(const Layers& layers) {
  return keeps_first(layers) || layers.has(Layer::normal) || layers.has(Layer::albedo);
}

}  // namespace

PixelWindow film_window(const RenderOptions& options) {
  const PixelWindow part = options.crop.value_or(PixelWindow{0, 0, options.width, options.height});
  return options.noise > 0 ? whole_tiles(part, options.width, options.height) : part;
}

Layers film_layers(const RenderOptions& options) {
  Layers layers = options.layers;
  if (options.noise > 0) layers.add(Layer::variance);
  // These two are no planes of a film.
  return layers.remove(Layer::samples).remove(Layer::sums);
}

Result<Rendering> render(const Scene& scene, const Accelerator& accelerator, const RenderOptions& options,
                         const RenderControl& control) {
  const auto begun = Clock::now();
  const Result<CameraRays> camera = CameraRays::create(scene.camera, options.width, options.height);
  if (!camera) return camera.error();
  const LitScene lit(scene);
  std::optional<SurfaceFeatures> features;
  if (shows_surfaces(options.layers)) features.emplace(scene, lit);

  Rendering rendering;
  rendering.film = control.resumed != nullptr
                       ? std::move(*control.resumed)
                       : Film(options.width, options.height, film_window(options), film_layers(options));
  assert(rendering.film.window() == film_window(options) && rendering.film.layers() == film_layers(options));
  FilmWork work(options, control, rendering.film);
  const int wanted = options.threads > 0 ? options.threads : available_threads();
  rendering.threads = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(wanted), work.tiles()));
  std::optional<SectionHatch> hatch;
  if (options.hatch) hatch.emplace(scene, *camera, *options.hatch, static_cast<int>(options.samples));
  std::vector<std::unique_ptr<TileWorker>> workers;
  for (int i = 0; i < rendering.threads; ++i) {
    workers.push_back(std::make_unique<TileWorker>(lit, features ? &*features : nullptr, hatch ? &*hatch : nullptr,
                                                   accelerator, *camera, options));
  }
  rendering.end = work.run(workers);
  rendering.done = work.done();
  rendering.cut = work.cut();
  for (const auto& worker : workers) rendering.statistics += worker->statistics();
  rendering.cpu_seconds = work.busy_seconds();
  rendering.seconds = seconds_since(begun);
  return rendering;
}

}  // namespace tenon
