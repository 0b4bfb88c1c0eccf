#include "render/albedo_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>

#include "render/microfacet.h"
#include "render/optics.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/albedo_table.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// What follows is compiled for each instruction set, for the compiler to make vectors of.
HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

// The cubic of Catmull and Rom through the four nodes around.
void FindAlbedo(const AlbedoTable::Nodes& nodes, const NumberBlock& cos, std::size_t size,
                NumberBlock& HWY_RESTRICT albedo) {
  constexpr double last = AlbedoTable::intervals - 1;
  for (std::size_t i = 0; i < size; ++i) {
    const double x = std::sqrt(std::max(0.0, cos[i])) * AlbedoTable::intervals;
    const double interval = x < last ? std::floor(x) : last;
    const double t = x - interval;
    const auto k = static_cast<std::size_t>(static_cast<int>(interval));
    const double a = nodes[k], b = nodes[k + 1], c = nodes[k + 2], d = nodes[k + 3];
    albedo[i] = b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(FindAlbedo);

namespace {

// The mean weight of drawn microfacets. They form a Fibonacci lattice (of F(n) points; Sloan and Joe, "Lattice Methods
// for Multiple Integration", 1994) on half of the circle, for the other half is its mirror image; it is stretched
// towards grazing microfacets, of which a narrow distribution has few. Where all is smooth but for light that would go
// below the surface, 4181 points leave 3e-5; total reflection bends the integrand more sharply, and 17711 leave 2e-4 in
// the worst of places (alpha from 0.01 to 1, cos from 0.02 to 1, against 832040 points).
double scattered(ScatteredPart part, double alpha, double eta, double cos) {
  const bool total_reflection = part != ScatteredPart::reflected_by_perfect_mirrors && eta > 1;
  const std::uint64_t count = total_reflection ? 17711 : 4181, step = total_reflection ? 10946 : 2584;
  const auto n = static_cast<double>(count);
  const Microfacets facets(alpha);
  const Vec3 wo{std::sqrt(std::max(0.0, 1 - cos * cos)), 0, cos};
  const double lambda_o = facets.lambda(wo);
  double sum = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double s = (static_cast<double>(i) + 0.5) / n, weight = 2 * s;
    const double u = (static_cast<double>(i * step % count) + 0.5) / n;
    const Vec3 m = facets.sample_visible(wo, {0.5 * u, 1 - s * s});
    const double fresnel =
        part == ScatteredPart::reflected_by_perfect_mirrors ? 1 : fresnel_dielectric(dot(wo, m), eta);
    const Vec3 reflected = reflect(-wo, m);
    if (reflected.z > 0) sum += weight * fresnel * (1 + lambda_o) / (1 + lambda_o + facets.lambda(reflected));
    if (part != ScatteredPart::all_of_dielectric) continue;
    const auto refracted = refract(-wo, m, eta);
    if (refracted && refracted->z < 0) {
      sum += weight * (1 - fresnel) * (1 + lambda_o) / (1 + lambda_o + facets.lambda(*refracted));
    }
  }
  return sum / n;
}

}  // namespace

AlbedoTable::AlbedoTable(ScatteredPart part, double alpha, double eta) {
  double* const values = &nodes_[1];
  for (int i = 1; i <= intervals; ++i) {
    const double x = static_cast<double>(i) / intervals;
    values[i] = scattered(part, alpha, eta, x * x);
  }
  // Straight along the surface every microfacet is masked; the value there is only ever interpolated towards.
  values[0] = std::max(0.0, 2 * values[1] - values[2]);
  nodes_.front() = 2 * values[0] - values[1];
  nodes_.back() = 2 * values[intervals] - values[intervals - 1];
}

void AlbedoTable::find(const NumberBlock& cos, std::size_t size, NumberBlock& albedo) const {
  HWY_DYNAMIC_DISPATCH(FindAlbedo)(nodes_, cos, size, albedo);
}

AlbedoTables& AlbedoTables::shared() {
  static AlbedoTables tables;
  return tables;
}

const AlbedoTable& AlbedoTables::get(ScatteredPart part, double alpha, double eta) {
  const Key key{part, alpha, eta};
  {
    const std::shared_lock lock(mutex_);
    if (const auto found = tables_.find(key); found != tables_.end()) return *found->second;
  }
  auto made = std::make_unique<AlbedoTable>(part, alpha, eta);
  const std::unique_lock lock(mutex_);
  return *tables_.try_emplace(key, std::move(made)).first->second;
}

}  // namespace tenon
#endif
