#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "tenon/accel/accelerator.h"
#include "tenon/render/progress.h"
#include "tenon/render/renderer.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// What the oracle says of a ray.
struct StoredAnswer {
  Hit hit;                   ///< the first boundary; of a shadow ray, where the shadow is not asked for
  bool stopped = false;      ///< shadow rays: an opaque boundary lies on the way
  std::uint32_t passed = 0;  ///< shadow rays that are not stopped: the transparent boundaries on the way
};

/// The rays of a picture, by kind, with the oracle's answers: primary, shadow, reflected and refracted, each as the
/// illumination model asked for it, with the hit it starts at.
class StoredRays {
 public:
  /// Takes the picture with the oracle and keeps its rays.
  static Result<StoredRays> record(const Scene& scene, const Accelerator& oracle, RenderOptions options,
                                   ProgressCounters* progress = nullptr);

  const std::vector<RayQuery>& queries(RayKind kind) const { return queries_[static_cast<std::size_t>(kind)]; }
  const std::vector<StoredAnswer>& answers(RayKind kind) const { return answers_[static_cast<std::size_t>(kind)]; }
  std::size_t size() const;

  void add(const RayQuery& query, const StoredAnswer& answer);

 private:
  std::array<std::vector<RayQuery>, ray_kind_count> queries_;
  std::array<std::vector<StoredAnswer>, ray_kind_count> answers_;
  std::deque<Hit> starts_;  // what RayQuery::from points to
};

/// Adds rays that no camera sends, with the oracle's answers, as diffuse rays: from anywhere in and around the bounds,
/// so that many start inside, in any direction; every third along an axis and from a lattice, on whose planes faces
/// lie.
void add_scattered_rays(const Scene& scene, const Accelerator& oracle, std::size_t count, StoredRays& rays);

/// An accelerator that disagrees with the oracle about a ray.
struct Mismatch {
  RayQuery query;
  StoredAnswer expected, found;
};

/// What came of tracing stored rays through one accelerator, on one thread.
struct Replay {
  double seconds = 0;  ///< CPU seconds of tracing alone: rays are made, and answers compared, outside of it
  TraversalStatistics statistics;
  std::size_t mismatches = 0;
  std::optional<Mismatch> first;
};

/// Traces stored rays and compares the answers with the oracle's, bit for bit.
Replay replay(const Scene& scene, const Accelerator& accelerator, const StoredRays& rays,
              ProgressCounters* progress = nullptr);

/// Whether two accelerators say the same, bit for bit.
bool same_hit(const Hit& a, const Hit& b);

}  // namespace tenon
