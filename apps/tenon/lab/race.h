#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/lab.h"
#include "lab/lab_table.h"
#include "tenon/accel/accelerator.h"
#include "tenon/base/timing.h"
#include "tenon/film/film.h"
#include "tenon/render/renderer.h"

namespace tenon {

/// One way to take a picture: a scene and a structure over it.
struct Contender {
  std::string name;
  const LabScene* scene = nullptr;
  std::string accelerator;
};

/// What came of it.
struct RaceResult {
  std::string name;
  Timing build, render;  ///< CPU seconds
  AcceleratorFigures figures;
  TraversalStatistics statistics;    ///< of one picture
  std::size_t different_pixels = 0;  ///< from the first contender's picture

  double rays() const { return static_cast<double>(statistics.total().rays); }
  LabFigure build_figure() const { return {build.median(), build.spread(), ""}; }
  LabFigure render_figure() const { return {render.median(), render.spread(), ""}; }
  LabFigure per_ray_figure() const { return {render.median() / rays(), render.spread(), ""}; }
};

/// Builds every contender's structure, and takes the picture with each in turns, on one thread, in rounds. A structure
/// that takes long to build is built once.
/// @param options  of the picture; its size and threads are set here
/// @param rounds   0: those of the lab's effort
Result<std::vector<RaceResult>> race(Lab& lab, const std::vector<Contender>& contenders, RenderOptions options,
                                     int rounds = 0);

/// How many steps race() makes.
int race_steps(const Lab& lab, std::size_t contenders, int rounds = 0);

/// The median over the rounds of how many times faster one is, and how far that may be off.
Measured speedup(const RaceResult& slow, const RaceResult& fast);
LabFigure speedup_figure(const RaceResult& slow, const RaceResult& fast);

/// Of a kind of ray, or of several kinds together: counts a ray.
std::optional<double> next_box_calls_a_ray(const TraversalStatistics& statistics, const std::vector<RayKind>& kinds);
/// The share of intersections that the mailboxes answered.
double mailbox_share(const TraversalStatistics& statistics);

/// A figure that was counted.
inline LabFigure counted(double value) {
  return {value, 0, ""};
}

}  // namespace tenon
