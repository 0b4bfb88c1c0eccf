#pragma once

#include "tenon/math/color.h"
#include "tenon/math/vec3.h"

namespace tenon {

enum class LightKind { point, directional, spot };

/// A light without extent; its light does not fade with distance (as in the course).
struct Light {
  LightKind kind = LightKind::point;
  Vec3 position;             ///< point and spot
  Vec3 direction{0, 0, -1};  ///< directional and spot: where the light goes
  double angle = 30;         ///< spot: half the cone's opening, degrees
  double softness = 0.1;     ///< spot: the share of the angle over which the light fades out at the rim, 0..1
  Rgba color{1, 1, 1, 1};
  double intensity = 1;

  friend bool operator==(const Light&, const Light&) = default;
};

}  // namespace tenon
