#include "rays/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "tenon/base/parallel_for.h"

namespace tenon::bench {

namespace {

double trace_once(Tracer& tracer, const RaySet& set, int threads) {
  tracer.load(set, threads);
  const std::size_t blocks = (set.rays.size() + Tracer::block - 1) / Tracer::block;
  const auto trace = [&](std::size_t i, int worker) {
    tracer.trace(i * Tracer::block, std::min((i + 1) * Tracer::block, set.rays.size()), worker);
  };
  if (threads == 1) {
    return cpu_seconds([&] {
      for (std::size_t i = 0; i < blocks; ++i) trace(i, 0);
    });
  }
  const auto begun = std::chrono::steady_clock::now();
  parallel_for(blocks, threads, trace);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
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
  return bench::median(seconds);
}

double Timing::spread() const {
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  return (sorted[sorted.size() - 2] - sorted[1]) / 2 / median();
}

double ratio(const Timing& slow, const Timing& fast) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < slow.seconds.size(); ++i) ratios.push_back(slow.seconds[i] / fast.seconds[i]);
  return median(ratios);
}

double cpu_seconds(const std::function<void()>& work) {
  const auto now = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double begun = now();
  work();
  return now() - begun;
}

std::vector<Timing> time_tracers(std::span<const std::unique_ptr<Tracer>> tracers, const RaySet& set, int threads) {
  std::vector<Timing> timings;
  for (const auto& tracer : tracers) timings.push_back({tracer->name(), {}});
  for (int round = -1; round < rounds; ++round) {
    for (std::size_t i = 0; i < tracers.size(); ++i) {
      const double seconds = trace_once(*tracers[i], set, threads);
      if (round >= 0) timings[i].seconds.push_back(seconds);
    }
  }
  return timings;
}

}  // namespace tenon::bench
