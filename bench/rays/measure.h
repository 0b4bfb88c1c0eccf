#pragma once

#include <span>
#include <vector>

#include "rays/tracer.h"
#include "tenon/base/timing.h"

namespace tenon::bench {

inline constexpr int rounds = 5;

/// Lets every contender trace the rays once a round, in turns.
/// @param threads  with 1, seconds are CPU seconds; with more, seconds on the wall
std::vector<Timing> time_tracers(std::span<const std::unique_ptr<Tracer>> tracers, const RaySet& set, int threads);

}  // namespace tenon::bench
