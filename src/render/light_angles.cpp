#include "render/light_angles.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/light_angles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// What follows is compiled for each instruction set, for the compiler to make vectors of.
HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

void FindLightAngles(const Vec3Block& normal, const Vec3Block& to_light, const Vec3Block& direction, std::size_t size,
                     LightAngles& HWY_RESTRICT angles) {
  for (std::size_t i = 0; i < size; ++i) {
    const Vec3 n = normal[i], toward = to_light[i];
    const double share = 1 / length(toward);
    const Vec3 half = share * toward - direction[i];
    angles.incidence[i] = share * dot(n, toward);
    angles.highlight[i] = dot(n, half) / length(half);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(FindLightAngles);

void find_light_angles(const Vec3Block& normal, const Vec3Block& to_light, const Vec3Block& direction,
                       std::size_t count, LightAngles& angles) {
  HWY_DYNAMIC_DISPATCH(FindLightAngles)(normal, to_light, direction, whole_vectors(count), angles);
}

}  // namespace tenon
#endif
