#include "rays/measure.h"

#include <algorithm>
#include <chrono>

#include "tenon/base/parallel_for.h"

namespace tenon::bench {

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

std::vector<Timing> time_tracers(std::span<const std::unique_ptr<Tracer>> tracers, const RaySet& set, int threads) {
  std::vector<std::string> names;
  for (const auto& tracer : tracers) names.push_back(tracer->name());
  return take_turns(names, rounds, [&](std::size_t i) { return trace_once(*tracers[i], set, threads); });
}

}  // namespace tenon::bench
