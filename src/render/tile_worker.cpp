#include "render/tile_worker.h"

#include <algorithm>

#include "render/path.h"
#include "render/pixel_samples.h"
#include "render/primary_directions.h"
#include "render/whitted.h"

namespace tenon {

namespace {

std::unique_ptr<Integrator> make_integrator(const LitScene& scene, const Accelerator& accelerator,
                                            const RenderOptions& options) {
  if (options.integrator == IntegratorKind::path) {
    return std::make_unique<PathIntegrator>(scene, accelerator, Sampler(options.seed), options.depth);
  }
  return std::make_unique<WhittedIntegrator>(scene, accelerator, RecursionLimits{options.depth, options.threshold});
}

// Square by square: structures trace neighbours together, and squares lie closer together than rows.
template <class Visit>
void for_each_pixel(const PixelWindow& tile, const Visit& visit) {
  constexpr int side = 8;
  for (int y0 = tile.y0; y0 < tile.y1; y0 += side) {
    for (int x0 = tile.x0; x0 < tile.x1; x0 += side) {
      for (int y = y0; y < std::min(y0 + side, tile.y1); ++y) {
        for (int x = x0; x < std::min(x0 + side, tile.x1); ++x) visit(x, y);
      }
    }
  }
}

}  // namespace

TileWorker::TileWorker(const LitScene& scene, const SurfaceFeatures* features, const SectionHatch* hatch,
                       const Accelerator& accelerator, const CameraRays& camera, const RenderOptions& options)
    : features_(features),
      hatch_(hatch),
      accelerator_(accelerator),
      camera_(camera),
      samples_(options.samples),
      sampler_(options.seed),
      is_random_(options.integrator == IntegratorKind::path),
      transparent_(options.transparent),
      wants_spans_(options.layers.has(Layer::crossings) || options.layers.has(Layer::path_length)),
      context_(accelerator.make_context()),
      span_context_(wants_spans_ ? accelerator.make_context() : nullptr),
      integrator_(make_integrator(scene, accelerator, options)) {}

CutPaths TileWorker::take(const PixelWindow& tile, std::uint32_t first, std::uint32_t end, Film& film) {
  film.fetch(tile);
  for (std::uint32_t index = first; index < end; ++index) {
    aim(tile, index);
    accelerator_.first_hits(queries_, hits_, *context_);
    integrator_->radiance(queries_, hits_, ids_, light_, *context_);
    for (std::size_t i = 0; i < queries_.size(); ++i) add(i, film);
  }
  return integrator_->take_cut_paths();
}

void TileWorker::aim(const PixelWindow& tile, std::uint32_t index) {
  queries_.resize(tile.pixels());
  hits_.resize(tile.pixels());
  light_.resize(tile.pixels());
  places_.resize(tile.pixels());
  ids_.clear();
  for_each_pixel(tile, [&](int x, int y) { ids_.push_back({x, y, index}); });
  if (is_random_) {
    in_pixel_.resize(tile.pixels());
    sampler_.draw(ids_, sample_pair::pixel, in_pixel_);
  } else {
    const PixelSample shared = pixel_sample(index, samples_);
    in_pixel_.assign(tile.pixels(), {shared.x, shared.y});
  }
  on_lens_.resize(tile.pixels());
  if (camera_.has_lens()) sampler_.draw(ids_, sample_pair::lens, on_lens_);
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const SampleId& id = ids_[i];
    places_[i] = {id.x + in_pixel_[i].u, id.y + in_pixel_[i].v};
    queries_[i].pixel_x = id.x;
    queries_[i].pixel_y = id.y;
  }
  if (!camera_.has_lens() && !camera_.view().orthographic) return aim_from_eye();
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    queries_[i].ray = camera_.ray(places_[i].x, places_[i].y, on_lens_[i].u, on_lens_[i].v);
  }
}

// CameraRays::ray() where all rays start at one point, a block of them together.
void TileWorker::aim_from_eye() {
  const ScreenView& view = camera_.view();
  NumberBlock x{}, y{};
  Vec3Block direction;
  for (std::size_t begin = 0; begin < places_.size(); begin += block_size) {
    const std::size_t count = std::min(block_size, places_.size() - begin);
    for (std::size_t i = 0; i < count; ++i) x[i] = places_[begin + i].x, y[i] = places_[begin + i].y;
    find_primary_directions(view, x, y, count, direction);
    for (std::size_t i = 0; i < count; ++i) queries_[begin + i].ray = {view.eye, direction[i]};
  }
}

void TileWorker::add(std::size_t i, Film& film) {
  const RayQuery& query = queries_[i];
  Rgb& light = light_[i];
  double alpha = 1;
  if (hatch_ != nullptr) light = hatch_->light(hits_[i], places_[i]) * light;
  if (transparent_ && !hits_[i].found()) {
    light = {};
    alpha = 0;
  }
  if (film.layers().empty()) return film.add(query.pixel_x, query.pixel_y, light, alpha);
  FilmSample sample;
  sample.index = ids_[i].index;
  sample.light = light;
  sample.alpha = alpha;
  sample.is_in_second_half = is_in_second_half(sample.index, samples_);
  if (features_ != nullptr) features_->describe(hits_[i], sample);
  if (wants_spans_) look_through(query, sample);
  film.add(query.pixel_x, query.pixel_y, sample);
}

// A ray that starts inside has no boundary at 0, and an end at infinity is none.
void TileWorker::look_through(const RayQuery& query, FilmSample& sample) {
  spans_.clear();
  accelerator_.all_spans(query, spans_, *span_context_);
  for (const SolidSpan& span : spans_) {
    sample.crossings += span.t_in > 0 ? 1 : 0;
    sample.crossings += span.t_out < std::numeric_limits<double>::infinity() ? 1 : 0;
    sample.path_length += span.t_out - span.t_in;
  }
}

}  // namespace tenon
