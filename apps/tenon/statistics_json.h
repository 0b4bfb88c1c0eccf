#pragma once

#include <optional>
#include <span>
#include <string>

#include "scene_arguments.h"
#include "tenon/render/renderer.h"

namespace tenon {

/// What was measured of one structure.
struct Measurements {
  std::string accelerator;
  int threads = 1;
  double build_seconds = 0, render_seconds = 0;
  AcceleratorFigures figures;
  TraversalStatistics statistics;
  std::optional<DepthCut> cut;            ///< none: no picture
  std::optional<std::size_t> mismatches;  ///< none: compared with nothing
};

/// What `tenon compare --json` prints: an array of what `--stats` writes.
std::string statistics_json(std::span<const Measurements> all);

/// What `--stats` writes.
std::string statistics_json(const std::string& accelerator, const TraceableScene& traceable, int threads,
                            double render_seconds, const TraversalStatistics& statistics,
                            const std::optional<DepthCut>& cut);

}  // namespace tenon
