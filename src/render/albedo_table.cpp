#include "render/albedo_table.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>

#include "render/microfacet.h"
#include "render/optics.h"

namespace tenon {

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
  for (int i = 0; i <= intervals; ++i) {
    const double x = static_cast<double>(std::max(i, 1)) / intervals;
    values_[static_cast<std::size_t>(i)] = scattered(part, alpha, eta, x * x);
  }
  // Straight along the surface every microfacet is masked; the value there is only ever interpolated towards.
  values_[0] = std::max(0.0, 2 * values_[1] - values_[2]);
}

double AlbedoTable::operator()(double cos) const {
  const double x = std::sqrt(std::clamp(cos, 0.0, 1.0)) * intervals;
  const int i = std::min(static_cast<int>(x), intervals - 1);
  const double t = x - i;
  const auto value = [&](int k) { return values_[static_cast<std::size_t>(k)]; };
  // The cubic of Catmull and Rom through the four nodes around; beyond the ends it goes straight on.
  const double b = value(i), c = value(i + 1);
  const double a = i > 0 ? value(i - 1) : 2 * b - c, d = i + 2 <= intervals ? value(i + 2) : 2 * c - b;
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
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
