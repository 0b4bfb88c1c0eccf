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
  bool is_approximate = false;  ///< its picture may differ from the others'
};

/// What came of it.
struct RaceResult {
  std::string name;
  Timing build, render;  ///< CPU seconds
  AcceleratorFigures figures;
  TraversalStatistics statistics;  ///< of one picture
  std::size_t primitives = 0;
  Film picture;
  std::size_t different_pixels = 0;  ///< from the first contender's picture; 0 where it may differ

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

/// Says in the table which contenders took another picture than the first. None should.
void note_differences(const std::vector<RaceResult>& results, LabTable& table);

/// Pixels in which a component of the light is off by more than `tolerance`, as a share of all.
double share_of_different_pixels(const Film& a, const Film& b, double tolerance);

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
