#pragma once

#include <vector>

#include "tenon/accel/accelerator.h"
#include "tenon/base/error.h"
#include "tenon/image/picture.h"
#include "tenon/render/renderer.h"

namespace tenon {

/// What each pixel of a picture costs: all its samples, with their shadow rays and whatever else they lead to.
struct CostMap {
  PixelWindow window;                   ///< the part of the picture that was taken
  std::vector<double> primitive_tests;  ///< by pixel of the window, row by row; so are the others
  std::vector<double> cells_visited;
  std::vector<double> seconds;     ///< shading and all
  TraversalStatistics statistics;  ///< of all pixels: what the first two add up to, and more
  double render_seconds = 0;       ///< of the whole
  int threads = 1;
};

/// Takes a picture pixel by pixel and keeps what each costs in place of its colour.
/// @param accelerator  over scene.tree. What it does for many rays at once, it does here for those of one pixel
/// @param takes        how often each pixel is taken: its seconds are the least of them, for whatever else the machine
///                     does only adds to them. Counters are those of the first
/// @return the costs, or an input error about the camera
Result<CostMap> measure_cost(const Scene& scene, const Accelerator& accelerator, const RenderOptions& options,
                             int takes = 1, ProgressCounters* progress = nullptr);

}  // namespace tenon
