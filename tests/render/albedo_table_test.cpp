#include "render/albedo_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tenon {
namespace {

constexpr double pi = std::numbers::pi;

// Walter et al. 2007, written out once more in terms of angles, and integrated over the outgoing directions themselves
// instead of the microfacets: GGX (equation 33), Smith's masking by Heitz's Lambda, equations 20 and 21.
struct Reference {
  double alpha, eta;

  double distribution(double cos) const {
    const double tan2 = (1 - cos * cos) / (cos * cos), a2 = alpha * alpha;
    return a2 / (pi * std::pow(cos, 4) * (a2 + tan2) * (a2 + tan2));
  }
  double lambda(double cos) const {
    const double tan2 = (1 - cos * cos) / (cos * cos);
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
  }
  // The textbook form by angles.
  double fresnel(double cos) const {
    const double in = std::acos(std::min(1.0, cos)), sin_out = eta * std::sin(in);
    if (sin_out >= 1) return 1;
    if (in < 1e-6) return std::pow((1 - eta) / (1 + eta), 2);
    const double out = std::asin(sin_out);
    const double s = std::sin(in - out) / std::sin(in + out), p = std::tan(in - out) / std::tan(in + out);
    return (s * s + p * p) / 2;
  }

  double reflected(double cos_o, double cos_i, double phi, bool by_fresnel) const {
    const double sin_o = std::sqrt(1 - cos_o * cos_o), sin_i = std::sqrt(1 - cos_i * cos_i);
    const double hx = sin_o + sin_i * std::cos(phi), hy = sin_i * std::sin(phi), hz = cos_o + cos_i;
    const double h = std::sqrt(hx * hx + hy * hy + hz * hz);
    const double cos_m = hz / h, cos_om = (sin_o * hx + cos_o * hz) / h;
    return distribution(cos_m) / (1 + lambda(cos_o) + lambda(cos_i)) / (4 * cos_o) * (by_fresnel ? fresnel(cos_om) : 1);
  }
  // cos_i > 0 below the surface.
  double refracted(double cos_o, double cos_i, double phi) const {
    const double sin_o = std::sqrt(1 - cos_o * cos_o), sin_i = std::sqrt(1 - cos_i * cos_i);
    double hx = eta * sin_o + sin_i * std::cos(phi), hy = sin_i * std::sin(phi), hz = eta * cos_o - cos_i;
    const double sign = hz > 0 ? 1 : -1, h = sign * std::sqrt(hx * hx + hy * hy + hz * hz);
    hx /= h, hy /= h, hz /= h;
    const double cos_om = sin_o * hx + cos_o * hz,
                 cos_im = sin_i * std::cos(phi) * hx + sin_i * std::sin(phi) * hy - cos_i * hz;
    if (cos_om <= 0 || cos_im >= 0) return 0;
    const double bend = eta * cos_om + cos_im;
    return (1 - fresnel(cos_om)) * distribution(hz) / (1 + lambda(cos_o) + lambda(cos_i)) * cos_om * -cos_im /
           (cos_o * bend * bend);
  }

  // In steps of angles, which resolve narrow lobes straight on as well as light along the surface.
  double albedo(ScatteredPart part, double cos_o) const {
    constexpr int n = 500;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double theta = pi / 2 * (i + 0.5) / n, cos_i = std::cos(theta), sin_i = std::sin(theta);
      for (int j = 0; j < n; ++j) {
        const double phi = pi * (j + 0.5) / n;
        sum += sin_i * reflected(cos_o, cos_i, phi, part != ScatteredPart::reflected_by_perfect_mirrors);
        if (part == ScatteredPart::all_of_dielectric) sum += sin_i * refracted(cos_o, cos_i, phi);
      }
    }
    return sum * pi * pi / (static_cast<double>(n) * n);
  }
};

TEST(AlbedoTable, IsTheIntegralOverAllDirections) {
  for (const ScatteredPart part : {ScatteredPart::reflected_by_perfect_mirrors, ScatteredPart::reflected_by_dielectric,
                                   ScatteredPart::all_of_dielectric}) {
    for (const double eta : {1 / 1.5, 1.5}) {
      for (const double alpha : {0.3, 1.0}) {
        if (part == ScatteredPart::reflected_by_perfect_mirrors && eta > 1) continue;
        const AlbedoTable table(part, alpha, eta);
        // Upright microfacets, of which a wide distribution has many, and total reflection end the integrand in an
        // edge that the grid only finds to its step.
        const bool has_edge = alpha == 1 || (part != ScatteredPart::reflected_by_perfect_mirrors && eta > 1);
        const double near = has_edge ? 1e-3 : 1e-4;
        const NumberBlock cosines{0.15, 0.4, 0.77, 1.0};
        NumberBlock albedo;
        table.find(cosines, whole_vectors(4), albedo);
        for (std::size_t i = 0; i < 4; ++i) {
          const double cos = cosines[i];
          EXPECT_NEAR(albedo[i], (Reference{alpha, eta}.albedo(part, cos)), near)
              << "part " << static_cast<int>(part) << ", eta " << eta << ", alpha " << alpha << ", cos " << cos;
        }
      }
    }
  }
}

TEST(AlbedoTables, MakeEachOnce) {
  AlbedoTables tables;
  const AlbedoTable& first = tables.get(ScatteredPart::all_of_dielectric, 0.5, 1.5);
  EXPECT_EQ(&first, &tables.get(ScatteredPart::all_of_dielectric, 0.5, 1.5));
  EXPECT_NE(&first, &tables.get(ScatteredPart::all_of_dielectric, 0.5, 1 / 1.5));
}

}  // namespace
}  // namespace tenon
