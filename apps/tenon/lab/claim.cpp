#include "lab/claim.h"

#include <cmath>

namespace tenon {

JudgedClaim judge(const Claim& claim, const std::optional<Measured>& measured) {
  JudgedClaim judged{claim, Verdict::not_comparable, {}, 0, {}};
  if (!measured || !std::isfinite(measured->value)) return judged;
  judged.measured = measured->value;
  judged.spread = measured->spread;
  const double margin = measured->spread * std::fabs(measured->value);
  const double low = measured->value - margin, high = measured->value + margin;
  const auto& least = claim.at_least;
  const auto& most = claim.at_most;
  const bool below = least && measured->value < *least, above = most && measured->value > *most;
  if (below || !most) {
    judged.ratio_to_limit = measured->value / *least;
  } else if (above || !least) {
    judged.ratio_to_limit = measured->value / *most;
  }
  if ((least && high < *least) || (most && low > *most)) {
    judged.verdict = Verdict::fails;
  } else if ((!least || low >= *least) && (!most || high <= *most)) {
    judged.verdict = Verdict::holds;
  }
  return judged;
}

}  // namespace tenon
