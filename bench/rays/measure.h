#pragma once

#include <span>
#include <vector>

#include "rays/tracer.h"
#include "tenon/base/timing.h"

namespace tenon::bench {

inline constexpr int rounds = 5;

/// Loads rays and has a contender trace them.
/// @param threads  with 1, seconds are CPU seconds; with more, seconds on the wall
double trace_once(Tracer& tracer, const RaySet& set, int threads);

/// Lets every contender trace the rays once a round, in turns, by so many threads.
std::vector<Timing> time_tracers(std::span<const std::unique_ptr<Tracer>> tracers, const RaySet& set, int threads);

}  // namespace tenon::bench
