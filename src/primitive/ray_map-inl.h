// Rays taken to the frame of a primitive. Included once for each instruction set.

#if defined(TENON_PRIMITIVE_RAY_MAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_PRIMITIVE_RAY_MAP_INL_H_
#undef TENON_PRIMITIVE_RAY_MAP_INL_H_
#else
#define TENON_PRIMITIVE_RAY_MAP_INL_H_
#endif

#include <hwy/highway.h>

#include <type_traits>

#include "math/lane_numbers-inl.h"
#include "primitive/ray_map.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

/// A ray, or one a lane, in the frame of a primitive; see Placement::MappedRay.
/// @tparam V  Vec3, or LaneVec3
template <class V>
struct MappedLine {
  using Number = std::remove_cvref_t<decltype(V().x)>;

  Number shift;
  V origin, direction, origin_error, direction_error;
};

template <class V>
HWY_INLINE V Times(const RayMap::Rows& rows, const V& v) {
  return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

/// See Placement::to_local().
/// @param starts_here  the ray starts on the primitive
template <class V, class Condition>
HWY_INLINE MappedLine<V> MapLine(const RayMap& map, const V& origin, const V& direction, double tolerance,
                                 Condition starts_here) {
  using Number = typename MappedLine<V>::Number;
  MappedLine<V> mapped;
  const Number shift = dot(map.world_center - origin, direction) * (Number(1) / dot(direction, direction));
  const Condition is_finite = shift - shift == Number(0);
  mapped.shift = choose(starts_here | !is_finite, Number(0), shift);
  const V from_world_origin = origin - map.world_origin;
  mapped.origin = Times(map.rows, V(from_world_origin + mapped.shift * direction));
  mapped.direction = Times(map.rows, direction);
  mapped.direction_error = Times(map.relative_error, abs(direction));
  mapped.origin_error = map.constant_error + tolerance * map.row_length +
                        Times(map.relative_error, abs(from_world_origin)) +
                        magnitude(mapped.shift) * mapped.direction_error;
  return mapped;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#endif
