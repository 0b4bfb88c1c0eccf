#include "render/primary_directions.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/primary_directions.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// What follows is compiled for each instruction set, for the compiler to make vectors of.
HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

void FindPrimaryDirections(const ScreenView& view, const NumberBlock& x, const NumberBlock& y, std::size_t size,
                           Vec3Block& HWY_RESTRICT direction) {
  const ScreenView own = view;
  for (std::size_t i = 0; i < size; ++i) direction.set(i, primary_direction(own, x[i], y[i]));
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(FindPrimaryDirections);

void find_primary_directions(const ScreenView& view, const NumberBlock& x, const NumberBlock& y, std::size_t count,
                             Vec3Block& direction) {
  HWY_DYNAMIC_DISPATCH(FindPrimaryDirections)(view, x, y, whole_vectors(count), direction);
}

}  // namespace tenon
#endif
