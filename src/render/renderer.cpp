#include "tenon/render/renderer.h"

#include <chrono>
#include <memory>
#include <vector>

#include "render/lit_scene.h"
#include "render/path.h"
#include "render/pixel_samples.h"
#include "render/tiles.h"
#include "render/whitted.h"
#include "tenon/base/parallel_for.h"
#include "tenon/render/camera_rays.h"

namespace tenon {

namespace {

std::unique_ptr<Integrator> make_integrator(const LitScene& scene, const Accelerator& accelerator,
                                            const RenderOptions& options) {
  if (options.integrator == IntegratorKind::path) {
    return std::make_unique<PathIntegrator>(scene, accelerator, Sampler(options.seed), options.depth);
  }
  return std::make_unique<WhittedIntegrator>(scene, accelerator, RecursionLimits{options.depth, options.threshold});
}

// What one thread needs to render tiles. Primary rays go to the accelerator one sample of a whole tile at a time.
class TileWorker {
 public:
  TileWorker(const LitScene& scene, const Accelerator& accelerator, const CameraRays& camera,
             const RenderOptions& options)
      : accelerator_(accelerator),
        camera_(camera),
        samples_(static_cast<std::uint32_t>(options.samples)),
        sampler_(options.seed),
        is_random_(options.integrator == IntegratorKind::path),
        context_(accelerator.make_context()),
        integrator_(make_integrator(scene, accelerator, options)) {}

  void render(const Tile& tile, Film& film) {
    sums_.assign(tile.pixels(), Rgb{});
    for (std::uint32_t sample = 0; sample < samples_; ++sample) {
      aim(tile, sample);
      accelerator_.first_hits(queries_, hits_, *context_);
      integrator_->radiance(queries_, hits_, ids_, light_, *context_);
      for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += light_[i];
    }
    const double share = 1.0 / samples_;
    std::size_t i = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) film.set(x, y, sums_[i++] * share);
    }
  }

  const TraversalStatistics& statistics() const { return context_->statistics; }

 private:
  void aim(const Tile& tile, std::uint32_t sample) {
    queries_.resize(tile.pixels());
    hits_.resize(tile.pixels());
    ids_.resize(tile.pixels());
    light_.resize(tile.pixels());
    const PixelSample shared = pixel_sample(sample, samples_);
    std::size_t i = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const SampleId id = ids_[i] = {x, y, sample};
        RayQuery& query = queries_[i++];
        const Sample2 drawn = is_random_ ? sampler_(id, sample_pair::pixel) : Sample2{shared.x, shared.y};
        query.ray = camera_.ray(x + drawn.u, y + drawn.v);
        query.pixel_x = x;
        query.pixel_y = y;
      }
    }
  }

  const Accelerator& accelerator_;
  const CameraRays& camera_;
  std::uint32_t samples_;
  Sampler sampler_;
  bool is_random_;
  std::unique_ptr<TraceContext> context_;
  std::unique_ptr<Integrator> integrator_;
  std::vector<SampleId> ids_;
  std::vector<RayQuery> queries_;
  std::vector<Hit> hits_;
  std::vector<Rgb> light_;
  std::vector<Rgb> sums_;
};

}  // namespace

Result<Rendering> render(const Scene& scene, const Accelerator& accelerator, const RenderOptions& options,
                         ProgressCounters* progress) {
  const auto begun = std::chrono::steady_clock::now();
  const Result<CameraRays> camera = CameraRays::create(scene.camera, options.width, options.height);
  if (!camera) return camera.error();
  const LitScene lit(scene);
  const TileGrid tiles(options.width, options.height, options.tile_size);

  Rendering rendering;
  rendering.film = Film(options.width, options.height);
  const int wanted = options.threads > 0 ? options.threads : available_threads();
  rendering.threads = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(wanted), tiles.size()));
  std::vector<std::unique_ptr<TileWorker>> workers;
  for (int i = 0; i < rendering.threads; ++i) {
    workers.push_back(std::make_unique<TileWorker>(lit, accelerator, *camera, options));
  }
  if (progress != nullptr) {
    progress->total = static_cast<std::uint64_t>(options.width) * static_cast<std::uint64_t>(options.height) *
                      static_cast<std::uint64_t>(options.samples);
  }

  parallel_for(tiles.size(), rendering.threads, [&](std::size_t index, int number) {
    TileWorker& worker = *workers[static_cast<std::size_t>(number)];
    const std::uint64_t rays_before = worker.statistics().total().rays;
    worker.render(tiles[index], rendering.film);
    if (progress == nullptr) return;
    progress->done += tiles[index].pixels() * static_cast<std::uint64_t>(options.samples);
    progress->rays += worker.statistics().total().rays - rays_before;
  });

  for (const auto& worker : workers) rendering.statistics += worker->statistics();
  rendering.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return rendering;
}

}  // namespace tenon
