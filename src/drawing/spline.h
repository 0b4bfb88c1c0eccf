#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/vec2.h"

namespace tenon {

/// A rational B-spline of the plane.
struct Spline {
  int degree = 3;
  std::vector<double> knots;  ///< that do not fall, degree + 1 more than there are points
  std::vector<Vec2> points;
  std::vector<double> weights;  ///< positive, one a point; empty where all are 1

  /// Why it is none; empty when it will do.
  std::string check() const;
  double begin() const { return knots[static_cast<std::size_t>(degree)]; }
  double end() const { return knots[points.size()]; }
  /// De Boor's algorithm.
  Vec2 point(double t) const;
};

}  // namespace tenon
