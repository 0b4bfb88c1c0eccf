#pragma once

#include <cstdint>

#include "tenon/accel/accelerator.h"
#include "tenon/base/error.h"
#include "tenon/base/statistics.h"
#include "tenon/render/film.h"
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
  int width = 640, height = 480;  ///< pixels
  IntegratorKind integrator = IntegratorKind::whitted;
  int samples = 1;                        ///< primary rays for each pixel; whitted: a single one passes its centre
  int depth = 8;                          ///< levels of the tree of rays; 1: no reflected and refracted rays
  double threshold = invisible_share(8);  ///< whitted: rays whose cumulative product is no larger are not traced
  std::uint64_t seed = 0;                 ///< path: of everything drawn at random
  int threads = 0;                        ///< 0: all cores
  int tile_size = 16;                     ///< pixels; no pixel depends on it
};

struct Rendering {
  Film film;
  TraversalStatistics statistics;
  double seconds = 0;
  int threads = 1;
};

/// Takes the picture of a scene with its camera. Every pixel is the mean of its samples (box filter). The same bytes
/// come of any number of threads and any tile size.
/// @param accelerator  over scene.tree
/// @param progress     counts samples and rays; may be null
/// @return the picture, or an input error about the camera
Result<Rendering> render(const Scene& scene, const Accelerator& accelerator, const RenderOptions& options,
                         ProgressCounters* progress = nullptr);

}  // namespace tenon
