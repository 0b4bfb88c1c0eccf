#include "drawing/spline.h"

#include <algorithm>

namespace tenon {

std::string Spline::check() const {
  if (degree < 1 || degree > 15) return "the degree of a spline goes from 1 to 15";
  if (points.size() <= static_cast<std::size_t>(degree)) return "a spline needs more control points than its degree";
  if (knots.size() != points.size() + static_cast<std::size_t>(degree) + 1) {
    return "a spline of " + std::to_string(points.size()) + " control points and degree " + std::to_string(degree) +
           " needs " + std::to_string(points.size() + static_cast<std::size_t>(degree) + 1) + " knots, not " +
           std::to_string(knots.size());
  }
  if (!std::is_sorted(knots.begin(), knots.end())) return "the knots of a spline must not fall";
  if (!weights.empty() && weights.size() != points.size()) return "a spline needs as many weights as control points";
  if (std::any_of(weights.begin(), weights.end(), [](double w) { return !(w > 0); })) {
    return "the weights of a spline must be positive";
  }
  if (!(begin() < end())) return "the knots of a spline are all the same";
  return {};
}

Vec2 Spline::point(double t) const {
  const auto p = static_cast<std::size_t>(degree);
  // The last span that is not empty ends the curve.
  const auto behind =
      std::upper_bound(knots.begin() + degree, knots.begin() + static_cast<std::ptrdiff_t>(points.size()), t);
  std::size_t k = static_cast<std::size_t>(behind - knots.begin()) - 1;
  while (k > p && !(knots[k] < knots[k + 1])) --k;
  std::vector<Vec2> d(p + 1);
  std::vector<double> w(p + 1);
  for (std::size_t j = 0; j <= p; ++j) {
    w[j] = weights.empty() ? 1 : weights[j + k - p];
    d[j] = w[j] * points[j + k - p];
  }
  for (std::size_t r = 1; r <= p; ++r) {
    for (std::size_t j = p; j >= r; --j) {
      const double low = knots[j + k - p], high = knots[j + 1 + k - r];
      const double s = high > low ? (t - low) / (high - low) : 0;
      d[j] = (1 - s) * d[j - 1] + s * d[j];
      w[j] = (1 - s) * w[j - 1] + s * w[j];
    }
  }
  return 1 / w[p] * d[p];
}

}  // namespace tenon
