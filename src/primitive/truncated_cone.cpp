#include "primitive/truncated_cone.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "primitive/check.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// The coefficients of (low + slope z)².
std::array<double, 3> square_of(double low, double slope) {
  return {low * low, 2 * low * slope, slope * slope};
}

// With a semi-axis that shrinks by more than this, the sides of the surface come so near to each other at that end that
// a degree of 4 has no bits left to tell them apart.
constexpr double most_taper = 1024;

}  // namespace

// x² b² + y² a² - a² b² <= 0.
void TruncatedCone::prepare() {
  if (!check().empty()) return;
  const std::array<double, 3> a = square_of(a1, (a2 - a1) / h), b = square_of(b1, (b2 - b1) / h);
  PolynomialTerms terms;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    terms.push_back({2, 0, i, b[k]});
    terms.push_back({0, 2, i, a[k]});
    for (int j = 0; j < 3; ++j) terms.push_back({0, 0, i + j, -(a[k] * b[static_cast<std::size_t>(j)])});
  }
  const double x = std::max(a1, a2), y = std::max(b1, b2);
  // A slope takes two roundings, its square four and one, the product of two of those one more.
  solid_ = AlgebraicSolid(Polynomial3(terms, gamma(11)), {{-x, -y, 0}, {x, y, h}}, RootIsolation::interval,
                          RootRefinement::newton);
}

std::string TruncatedCone::check() const {
  const std::string problem = check_lengths(name, {{"h", h}, {"a1", a1}, {"b1", b1}, {"a2", a2}, {"b2", b2}});
  if (!problem.empty()) return problem;
  const double taper = std::max({a1 / a2, a2 / a1, b1 / b2, b2 / b1});
  if (taper > most_taper) {
    return "truncated_cone with a semi-axis that becomes " + shortest(taper) +
           " times smaller; that is more than 1024, and only a point (both semi-axes 0) can be thinner";
  }
  return {};
}

double TruncatedCone::support(const Vec3& n) const {
  const auto across = [&n](double a, double b) { return std::sqrt(a * a * n.x * n.x + b * b * n.y * n.y); };
  return std::max(across(a1, b1), across(a2, b2) + h * n.z);
}

void TruncatedCone::spans(const LocalRay& ray, Spans& out) const {
  solid_.spans(ray, out);
}

Region TruncatedCone::classify(const LocalBox& box) const {
  const Region region = solid_.classify(box);
  if (region != Region::straddles) return region;
  if (is_separated(box, solid_.normal(box.center, AlgebraicSolid::surface), *this)) return Region::outside;
  return is_separated_by_box_faces(box, *this) ? Region::outside : Region::straddles;
}

Vec3 TruncatedCone::normal(const Vec3& point, std::uint32_t face) const {
  return solid_.normal(point, face);
}

}  // namespace tenon
