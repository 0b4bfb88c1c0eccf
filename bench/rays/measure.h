#pragma once

#include <functional>
#include <span>
#include <vector>

#include "rays/tracer.h"

namespace tenon::bench {

/// What a contender took in each round.
struct Timing {
  std::string name;
  std::vector<double> seconds;

  double median() const;
  /// Half of the distance between the second slowest and the second fastest round, relative to the median.
  double spread() const;
};

double median(std::vector<double> values);
double geometric_mean(const std::vector<double>& values);

/// The median over the rounds of slow's time over fast's in the same round: how many times faster `fast` is.
double ratio(const Timing& slow, const Timing& fast);

inline constexpr int rounds = 5;

/// Lets every contender trace the rays once a round, in turns, so that what slows the machine down for a while slows
/// all of them; a round before counts for nothing.
/// @param threads  with 1, seconds are CPU seconds; with more, seconds on the wall
std::vector<Timing> time_tracers(std::span<const std::unique_ptr<Tracer>> tracers, const RaySet& set, int threads);

/// CPU seconds of all threads of this process that a piece of work takes.
double cpu_seconds(const std::function<void()>& work);

}  // namespace tenon::bench
