#include "tenon/base/timing.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace tenon {

namespace {

double clock_seconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += std::log(v);
  return std::exp(sum / static_cast<double>(values.size()));
}

double Timing::median() const {
  return tenon::median(seconds);
}

double Timing::spread() const {
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t left_out = sorted.size() >= 5 ? 1 : 0;
  const double width = sorted[sorted.size() - 1 - left_out] - sorted[left_out];
  return width > 0 ? width / 2 / median() : 0;
}

double ratio(const Timing& slow, const Timing& fast) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < slow.seconds.size(); ++i) ratios.push_back(slow.seconds[i] / fast.seconds[i]);
  return median(ratios);
}

std::vector<Timing> take_turns(const std::vector<std::string>& names, int rounds,
                               FunctionRef<double(std::size_t contender)> run) {
  std::vector<Timing> timings;
  for (const std::string& name : names) timings.push_back({name, {}});
  for (int round = -1; round < rounds; ++round) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double seconds = run(i);
      if (round >= 0) timings[i].seconds.push_back(seconds);
    }
  }
  return timings;
}

double cpu_seconds(FunctionRef<void()> work) {
  const double begun = clock_seconds(CLOCK_PROCESS_CPUTIME_ID);
  work();
  return clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - begun;
}

double thread_cpu_seconds() {
  return clock_seconds(CLOCK_THREAD_CPUTIME_ID);
}

}  // namespace tenon
