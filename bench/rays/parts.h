#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "rays/report.h"
#include "tenon/base/error.h"

namespace tenon::bench {

/// What the parts are told.
struct PartOptions {
  std::string accelerator;           ///< Tenon's contender, as `tenon --accel`
  int threads = 1;                   ///< what "all cores" means
  int largest_growth = 1'000'000;    ///< spheres of the largest scene of `growth`
  std::vector<std::string> scenes;   ///< of scenes/bench, which every contender traces
  std::vector<std::string> files;    ///< scene files that `structures` is to compare on instead
  std::vector<std::string> rays;     ///< kinds of ray to trace
  std::vector<std::string> against;  ///< the structures to compare with; empty: all of them, on OpenSCAD's examples too

  bool traces(std::string_view kind) const { return std::find(rays.begin(), rays.end(), kind) != rays.end(); }
};

/// Tenon against Embree on meshes within a quarter of a pixel, and on bare balls.
Status run_embree(const PartOptions& options, Report& report);
/// The accelerator against every structure of the papers.
Status run_structures(const PartOptions& options, Report& report);
/// A box less ever more spheres of the same volume.
Status run_growth(const PartOptions& options, Report& report);
/// All cores against one.
Status run_cores(const PartOptions& options, Report& report);
/// Path tracing as the thesis renders (8 samples, depth 20) against bare incoherent rays, and all cores against one.
Status run_path(const PartOptions& options, Report& report);
/// From the scene's text to the first ray, against making a mesh and its tree.
Status run_start(const PartOptions& options, Report& report);
/// Whole pictures against POV-Ray's.
Status run_povray(const PartOptions& options, Report& report);

/// The Stanford bunny in Booleans against winding numbers, and bare against Embree.
Status run_bunny(const PartOptions& options, Report& report);

}  // namespace tenon::bench
