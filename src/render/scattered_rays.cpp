#include <cmath>
#include <cstdint>

#include "tenon/render/compare.h"

namespace tenon {

namespace {

// SplitMix64 (Steele, Lea, Flood 2014): the same rays everywhere, which the standard's distributions do not promise.
class Random {
 public:
  double next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  Vec3 in_cube() {
    const double x = next(), y = next();
    return {2 * x - 1, 2 * y - 1, 2 * next() - 1};
  }

 private:
  std::uint64_t state_ = 0;
};

Box3 finite_bounds(const Scene& scene) {
  const Box3 bounds = scene_figures(scene).bounds;
  return bounds.is_bounded() ? bounds : Box3{{-1, -1, -1}, {1, 1, 1}};
}

}  // namespace

void add_scattered_rays(const Scene& scene, const Accelerator& oracle, std::size_t count, StoredRays& rays) {
  const Box3 bounds = finite_bounds(scene);
  const Vec3 center = bounds.center(), half = bounds.size() * 0.5;
  const std::unique_ptr<TraceContext> context = oracle.make_context();
  Random random;
  for (std::size_t i = 0; i < count; ++i) {
    RayQuery query;
    query.kind = RayKind::diffuse;
    Vec3 place = random.in_cube();
    Vec3 direction = random.in_cube();
    if (i % 3 == 0) {
      constexpr double lattice = 16;
      for (int axis = 0; axis < 3; ++axis) place[axis] = std::round(place[axis] * lattice) / lattice;
      const int along = static_cast<int>(i / 3 % 3);
      const double sign = direction[along] < 0 ? -1 : 1;
      direction = {};
      direction[along] = sign;
    }
    query.ray = {center + 1.3 * (half * place), direction};
    rays.add(query, {oracle.first_hit(query, *context)});
  }
}

}  // namespace tenon
