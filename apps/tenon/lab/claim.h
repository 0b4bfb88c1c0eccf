#pragma once

#include <optional>
#include <string>

#include "lab/measured.h"

namespace tenon {

/// What a paper claims, in a form that figures can contradict: some ratio lies between two limits.
struct Claim {
  std::string id;
  std::string text;    ///< in words
  std::string source;  ///< where the paper says so
  std::string ratio;   ///< what is measured, in words
  std::optional<double> at_least, at_most;
  std::string why_it_holds, why_it_fails, why_undecided;  ///< where the reason was looked into
};

enum class Verdict { holds, fails, not_comparable };

struct JudgedClaim {
  Claim claim;
  Verdict verdict = Verdict::not_comparable;
  std::optional<double> measured;
  double spread = 0;
  /// Of what was measured to the limit that it keeps or misses; none between two limits.
  std::optional<double> ratio_to_limit;
};

/// Holds where the whole range of the measurement keeps both limits; fails where none of it keeps one of them. What is
/// in between, or was not measured, is not comparable.
JudgedClaim judge(const Claim& claim, const std::optional<Measured>& measured);

}  // namespace tenon
