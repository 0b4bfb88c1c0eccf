#pragma once

#include <optional>

#include "primitive/placement.h"
#include "support/quad.h"
#include "support/random.h"

namespace tenon {

/// One transformation of a scene: as double has it, and exactly.
struct ExactStep {
  Affine3 map;
  exact::Map truth;
};

inline ExactStep written(const Affine3& map) {
  return {map, exact::Map(map)};
}

inline ExactStep random_step(Random& random) {
  switch (random.below(6)) {
    case 0: {
      const Vec3 angles = 360 * random.in_cube();
      return {Affine3::rotate(angles), exact::Map::rotate(angles)};
    }
    case 1: {
      const Vec3 angles{90.0 * random.below(4), 15.0 * random.below(24), 45.0 * random.below(8)};
      return {Affine3::rotate(angles), exact::Map::rotate(angles)};
    }
    case 2: {
      const double s = random.magnitude(-6, 6);
      return written(Affine3::scale({s, s, s}));
    }
    case 3:
      return written(
          Affine3::scale({random.sign() * random.magnitude(-2, 2), random.magnitude(-2, 2), random.magnitude(-2, 2)}));
    case 4: {
      // A shear, as `multmatrix` writes it.
      Affine3 shear;
      shear.m[0][1] = random.uniform(-2, 2);
      shear.m[1][2] = random.uniform(-2, 2);
      shear.m[2][0] = random.chance(0.5) ? random.uniform(-0.3, 0.3) : 0;
      return {shear, exact::Map(shear)};
    }
    default: {
      const Vec3 n = random.direction();
      const exact::Vec<exact::Quad> e(n);
      const exact::Quad two = exact::Quad(2) / dot(e, e);
      ExactStep step{Affine3::mirror(n), {}};
      const exact::Quad c[3] = {e.x, e.y, e.z};
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) step.truth.m[i][j] -= two * c[i] * c[j];
      }
      return step;
    }
  }
}

/// A chain of transformations, composed by the code under test and exactly.
struct RandomChain {
  BoundedAffine3 map;
  exact::Map truth;

  RandomChain() = default;
  explicit RandomChain(Random& random) {
    for (int i = random.below(4); i >= 0; --i) append(random_step(random));
    if (random.chance(0.7)) append(written(Affine3::translate(random.magnitude(-3, 6) * random.in_cube())), true);
  }
  void append(const ExactStep& step, bool first = false) {
    if (first) {
      map = BoundedAffine3::elementary(step.map) * map;
      truth = step.truth * truth;
    } else {
      map = map * BoundedAffine3::elementary(step.map);
      truth = truth * step.truth;
    }
  }
};

}  // namespace tenon
