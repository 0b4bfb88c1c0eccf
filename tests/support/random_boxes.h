#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "tenon/math/box3.h"

/// Boxes without primitives, for tests of trees alone.
namespace tenon::boxes {

/// A number from a to b.
inline double random_number(std::mt19937_64& rng, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(rng);
}

inline Vec3 random_point(std::mt19937_64& rng, const Box3& within) {
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = random_number(rng, within.lower[axis], within.upper[axis]);
  return p;
}

/// Boxes in a cube of side 20. Every third on a lattice, so that many share bounds; every seventh flat.
inline std::vector<Box3> random_boxes(std::mt19937_64& rng, std::size_t count) {
  std::vector<Box3> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 a = random_point(rng, {{-10, -10, -10}, {9, 9, 9}});
    Vec3 size = random_point(rng, {{0, 0, 0}, {2, 2, 2}});
    for (int axis = 0; axis < 3 && i % 3 == 0; ++axis) {
      a[axis] = std::floor(a[axis]);
      size[axis] = std::ceil(size[axis]);
    }
    if (i % 7 == 0) size[static_cast<int>(i / 7 % 3)] = 0;
    boxes.push_back({a, a + size});
  }
  return boxes;
}

}  // namespace tenon::boxes
