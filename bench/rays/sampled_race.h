#pragma once

#include <memory>
#include <span>
#include <vector>

#include "rays/tracer.h"
#include "tenon/base/timing.h"

namespace tenon::bench {

struct SampledRace {
  std::vector<Timing> timings;             ///< by contender: CPU seconds of one thread, as if it had traced all rays
  std::vector<std::size_t> disagreements;  ///< by contender: rays on which it and the first do not agree
};

/// Has contenders take turns of which the slow take a hundred times as long as the fast: who would need longer for a
/// round than a tenth of a second traces a sample of the rays, in every round the same. What part of all the work that
/// is, the first contender tells, which traces both: so by chance easy rays make no difference to how the others stand
/// to it (the ratio estimator; Cochran, "Sampling Techniques", 1977, chapter 6).
/// @param tracers  one at least; they have no rays loaded afterwards
/// @param set      of one ray at least
SampledRace race_on_samples(std::span<const std::unique_ptr<Tracer>> tracers, const RaySet& set);

}  // namespace tenon::bench
