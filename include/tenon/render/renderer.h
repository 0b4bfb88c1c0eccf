#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "tenon/accel/accelerator.h"
#include "tenon/base/error.h"
#include "tenon/base/statistics.h"
#include "tenon/film/film.h"
#include "tenon/film/film_part.h"
#include "tenon/render/depth_cut.h"
#include "tenon/render/hatch.h"
#include "tenon/render/progress.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// The share of a pixel below which a ray cannot be seen: half a step of an encoded component, where the steps are
/// finest in linear light. That is next to black, where sRGB's slope is 12.92. A ray that carries the light of a white
/// surface and less than this share of the pixel moves no component by more than rounding does.
constexpr double invisible_share(int bits) {
  return 0.5 / (static_cast<double>((1ULL << bits) - 1) * 12.92);
}

/// How light is followed.
enum class IntegratorKind {
  whitted,  ///< the complete illumination model of Bouatouch's course: nothing is drawn at random
  path,     ///< path tracing: light from everywhere, free of bias, noisy until there are many samples
};

struct RenderOptions {
  int width = 640, height = 480;    ///< of the whole picture, pixels
  std::optional<PixelWindow> crop;  ///< the part of the picture that is taken; none: all of it
  IntegratorKind integrator = IntegratorKind::whitted;
  std::uint32_t samples = 1;                ///< primary rays for each pixel; whitted: a single one passes its centre
  std::uint32_t first_sample = 0;           ///< samples before this one are left out
  std::optional<std::uint32_t> end_sample;  ///< samples from this one on are left out
  int depth = 8;                            ///< levels of the tree of rays; 1: no reflected and refracted rays
  double threshold = invisible_share(8);    ///< whitted: rays whose cumulative product is no larger are not traced
  std::uint64_t seed = 0;                   ///< path: of everything drawn at random
  std::optional<HatchOptions> hatch;        ///< lines across the cut faces of a section view
  bool transparent = false;                 ///< the background is left out, and alpha says how much of a pixel it fills
  Layers layers;                            ///< what the film keeps beside the colour
  double noise = 0;    ///< tiles get no more samples once their noise() is no more than this; 0: all get all samples
  double seconds = 0;  ///< no new samples after this time, but one for each pixel; 0: no end
  int threads = 0;     ///< 0: all cores
};

/// How a picture ended.
enum class RenderEnd { finished, out_of_time, interrupted };

struct Rendering {
  /// Of the crop window; with a noise target, of all tiles that have a part in it.
  Film film;
  std::vector<SampleBox> done;
  RenderEnd end = RenderEnd::finished;
  TraversalStatistics statistics;
  DepthCut cut;            ///< of the samples that were taken now, where some were taken before
  double seconds = 0;      ///< on the wall
  double cpu_seconds = 0;  ///< of taking samples alone, over all threads: what is made once for a picture is not in it
  int threads = 1;
};

/// What goes on beside the work. Everything may be left out.
struct RenderControl {
  ProgressCounters* progress = nullptr;         ///< counts samples and rays
  std::function<bool()> interrupted = nullptr;  ///< asked before each tile; once true, the work ends
  double checkpoint_seconds = 60;               ///< how long to work between two checkpoints
  /// Keeps what there is, so that nothing is lost. No thread works meanwhile.
  std::function<void(const Film& film, const std::vector<SampleBox>& done)> checkpoint = nullptr;
  Film* resumed = nullptr;  ///< a film that a checkpoint kept of the same picture: its samples are not taken again
};

/// Takes the picture of a scene with its camera. Every pixel is the mean of its samples (box filter). The same bytes
/// come of any number of threads, however the work is cut into parts (crop, first_sample, end_sample, checkpoints) and
/// put together again (merge). Samples are taken in rounds over the whole picture, so that it is there early, if
/// grainy.
/// @param accelerator  over scene.tree
/// @return the picture, or an input error about the camera
Result<Rendering> render(const Scene& scene, const Accelerator& accelerator, const RenderOptions& options,
                         const RenderControl& control = {});

/// Window and layers of the film that such a picture is taken on (Rendering::film).
PixelWindow film_window(const RenderOptions& options);
Layers film_layers(const RenderOptions& options);

}  // namespace tenon
