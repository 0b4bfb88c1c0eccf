#pragma once

#include <cstdint>
#include <span>

#include "render/sampler.h"
#include "tenon/accel/accelerator.h"
#include "tenon/math/color.h"

namespace tenon {

/// Paths that ended at the limit of their depth, and by what it is told how much light they would have met. Light is
/// the mean of its components, added up over samples.
struct CutPaths {
  std::uint64_t paths = 0;
  double throughput = 0;                     ///< that they carried: the light they meet times this reaches the camera
  double light = 0;                          ///< of all paths
  double earlier_light = 0, late_light = 0;  ///< from surfaces in the last but one and the last quarter of the depth

  CutPaths& operator+=(const CutPaths& o) {
    paths += o.paths;
    throughput += o.throughput;
    light += o.light;
    earlier_light += o.earlier_light;
    late_light += o.late_light;
    return *this;
  }
};

/// Finds the light that comes back along primary rays. One for each thread: it keeps scratch memory.
///
/// It is given many rays at once, such as those of a tile, so that it can follow them together, one bounce of all
/// before the next: structures trace many rays faster than one. What comes back along a ray depends on it and on its
/// sample alone, not on the rays beside it.
class Integrator {
 public:
  virtual ~Integrator() = default;

  /// @param primary  rays of length 1
  /// @param hits     what each meets first
  /// @param samples  which sample of which pixel each belongs to
  /// @param light    receives what comes back along each; all four have one length
  /// @param context  of this thread
  virtual void radiance(std::span<const RayQuery> primary, std::span<const Hit> hits, std::span<const SampleId> samples,
                        std::span<Rgb> light, TraceContext& context) = 0;

  /// What was cut in calls of radiance() since this was asked last.
  virtual CutPaths take_cut_paths() { return {}; }

 protected:
  Integrator() = default;
  Integrator(const Integrator&) = default;
  Integrator& operator=(const Integrator&) = default;
};

}  // namespace tenon
