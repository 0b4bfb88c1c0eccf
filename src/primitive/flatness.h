#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "tenon/math/vec3.h"
#include "tenon/primitive/primitive_store.h"

namespace tenon {

/// The plane of loops of corners: Newell's normal, of length 1, through the corners' middle. The normal is zero where
/// the loops have no area.
inline Plane plane_of_loops(std::span<const std::vector<Vec3>> loops) {
  Vec3 normal, middle;
  double count = 0;
  for (const std::vector<Vec3>& loop : loops) {
    for (const Vec3& p : loop) {
      middle += p;
      ++count;
    }
  }
  middle = middle / std::max(count, 1.0);
  for (const std::vector<Vec3>& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      normal += cross(loop[i] - middle, loop[(i + 1) % loop.size()] - middle);
    }
  }
  const double size = length(normal);
  if (size > 0) normal = normal / size;
  return {normal, dot(normal, middle)};
}

/// By how much corners deviate from their plane, where that is more than rounding: features below 2^-40 of the largest
/// coordinate are promised nowhere.
inline std::optional<double> find_deviation(std::span<const std::vector<Vec3>> loops) {
  const Plane plane = plane_of_loops(loops);
  double deviation = 0, largest = 0;
  for (const std::vector<Vec3>& loop : loops) {
    for (const Vec3& p : loop) {
      deviation = std::max(deviation, std::fabs(dot(plane.normal, p) - plane.d));
      largest = std::max(largest, max_component(abs(p)));
    }
  }
  return deviation > 0x1p-40 * largest ? std::optional(deviation) : std::nullopt;
}

}  // namespace tenon
