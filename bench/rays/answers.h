#pragma once

#include <string>
#include <vector>

#include "rays/tracer.h"
#include "tenon/base/error.h"

namespace tenon::bench {

/// Rays on which two contenders disagree: one meets something and the other does not, or (but for shadow rays) the
/// distances differ by more than a hundredth.
std::size_t count_disagreements(const std::vector<Answer>& a, const std::vector<Answer>& b, RayKind kind);

/// Saves what a contender says of the primary rays as a picture: colours are the normal's components, darker where
/// the surface turns away.
Status save_answers(const RaySet& primary, const Tracer& tracer, const std::string& path);

}  // namespace tenon::bench
