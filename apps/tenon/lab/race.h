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

/// A contender for each structure over one scene, named as `--accel` names it.
std::vector<Contender> structures_over(const LabScene& scene, const std::vector<std::string>& accelerators);

/// What came of a contender.
struct RaceResult {
  std::string name;
  Timing build, render;  ///< CPU seconds
  AcceleratorFigures figures;
  TraversalStatistics statistics;  ///< of one picture
  std::size_t primitives = 0;
  Film picture;

  double rays() const { return static_cast<double>(statistics.total().rays); }
  double tests_a_ray() const { return static_cast<double>(statistics.total().primitive_tests) / rays(); }
  double memory_bytes() const { return static_cast<double>(figures.memory_bytes); }
  double boxes() const { return static_cast<double>(figures.boxes); }
  Measured build_time() const { return {build.median(), build.spread()}; }
  Measured render_time() const { return {render.median(), render.spread()}; }
  Measured time_a_ray() const { return {render.median() / rays(), render.spread()}; }
};

/// How a race is run.
struct RaceRules {
  RenderOptions options;  ///< of the picture; its size is set by the scene
  int threads = 1;        ///< their CPU times are added up
  int rounds = 0;         ///< 0: those of the lab's effort
  /// All structures are in memory at once and take turns. Otherwise one comes after the other.
  bool together = true;
};

/// Builds every contender's structure, and takes the picture with each in turns, in rounds. Structures that take long
/// to build are built once. Pictures that should be the first contender's and are not are noted in the table.
Result<std::vector<RaceResult>> race(Lab& lab, const std::vector<Contender>& contenders, const RaceRules& rules,
                                     LabTable& table);

/// How many steps race() makes.
int race_steps(const Lab& lab, std::size_t contenders, int rounds = 0);

/// Pixels in which a component of the light is off by more than `tolerance`, as a share of all.
double share_of_different_pixels(const Film& a, const Film& b, double tolerance);
/// A tolerance: what a picture of 8 bits can show.
inline constexpr double visible_difference = 1.0 / 255;

/// The median over the rounds of how many times faster one is, and how far that may be off.
Measured speedup(const RaceResult& slow, const RaceResult& fast);

/// Of a kind of ray, or of several kinds together: counts a ray.
std::optional<double> next_box_calls_a_ray(const TraversalStatistics& statistics, const std::vector<RayKind>& kinds);
/// The share of intersections that the mailboxes answered.
double mailbox_share(const TraversalStatistics& statistics);

}  // namespace tenon
