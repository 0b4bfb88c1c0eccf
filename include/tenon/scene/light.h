#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tenon/base/error.h"
#include "tenon/math/color.h"
#include "tenon/math/vec3.h"

namespace tenon {

enum class LightKind { point, directional, spot, rectangle, sphere, environment, sky };

/// Light from all directions: a picture of the world around, by longitude and latitude.
struct LightMap {
  int width = 0, height = 0;  ///< pixels
  std::vector<float> rgb;     ///< linear light, rows from the zenith down; the middle of a row lies along +y
};

/// A light. Point, directional and spot lights have no extent and, as in the course, do not fade with distance unless
/// they are told to. The others are seen by the camera and in mirrors, and fade as light does.
struct Light {
  LightKind kind = LightKind::point;
  Vec3 position;             ///< point, spot, sphere: centre; rectangle: centre
  Vec3 direction{0, 0, -1};  ///< directional, spot, rectangle: where the light goes; sky: where the sun's light goes
  double angle = 30;         ///< spot: half the cone's opening, degrees
  double softness = 0.1;     ///< spot: the share of the angle over which the light fades out at the rim, 0..1
  double fade_distance = 0;  ///< point and spot: where the light has its intensity, when it is to fade; 0: it does not
  double radius = 1;         ///< sphere
  Vec3 edge_u{1, 0, 0};      ///< rectangle: its sides, in the plane that `direction` stands on
  Vec3 edge_v{0, 1, 0};      ///< rectangle
  double turbidity = 3;      ///< sky: haze, from 2 (clear) to 10
  double turn = 0;           ///< environment: around z, degrees, counterclockwise from above
  std::string file;          ///< environment: the picture; none: light of one colour from everywhere
  SourceLocation file_named_at;         ///< where the scene says so
  std::shared_ptr<const LightMap> map;  ///< environment: the picture, once it is read
  Rgba color{1, 1, 1, 1};

  /// Point, directional, spot: what a white matt surface that faces the light shows of it. Rectangle, sphere: radiance.
  /// Environment: factor of the picture. Sky: what white matt ground shows of it.
  double intensity = 1;

  /// Whether the light is the world around the scene.
  bool is_around() const { return kind == LightKind::environment || kind == LightKind::sky; }
};

}  // namespace tenon
