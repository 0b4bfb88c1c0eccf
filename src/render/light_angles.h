#pragma once

#include "render/block.h"

namespace tenon {

/// How light comes to surface points, as Phong's formula has it.
struct LightAngles {
  NumberBlock incidence;  ///< cosines between the normal and the way to the light
  NumberBlock highlight;  ///< cosines between the normal and what lies halfway from there to the viewer
};

/// @param normal     length 1
/// @param to_light   of any length
/// @param direction  of the ray that comes from the viewer, length 1
/// @param count      of points
void find_light_angles(const Vec3Block& normal, const Vec3Block& to_light, const Vec3Block& direction,
                       std::size_t count, LightAngles& angles);

}  // namespace tenon
