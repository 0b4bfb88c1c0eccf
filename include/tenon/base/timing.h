#pragma once

#include <string>
#include <vector>

#include "tenon/base/function_ref.h"

namespace tenon {

/// What a contender took in each round of a race.
struct Timing {
  std::string name;
  std::vector<double> seconds;

  double median() const;
  /// Half of the distance between the slowest and the fastest round, relative to the median; from five rounds on
  /// without the very slowest and the very fastest.
  double spread() const;
};

/// The middle one, or the mean of the two in the middle; of one value at least.
double median(std::vector<double> values);
double geometric_mean(const std::vector<double>& values);

/// The median over the rounds of slow's time over fast's in the same round: how many times faster `fast` is.
double ratio(const Timing& slow, const Timing& fast);

/// Lets contenders take turns, round by round, so that what slows the machine down for a while slows all of them.
/// @param names   of the contenders
/// @param rounds  that count; a round before them does not
/// @param run     lets a contender run once; returns what it took
std::vector<Timing> take_turns(const std::vector<std::string>& names, int rounds,
                               FunctionRef<double(std::size_t contender)> run);

/// CPU seconds of all threads of this process that a piece of work takes.
double cpu_seconds(FunctionRef<void()> work);

/// CPU seconds of the calling thread, since some moment.
double thread_cpu_seconds();

}  // namespace tenon
