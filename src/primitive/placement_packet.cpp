#include "primitive/placement.h"
#include "primitive/ray_packet.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "primitive/placement_packet.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "primitive/ray_map-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

void MapPacket(const RayMap& map, const RayPacket& rays, double tolerance, LocalRayPacket& local) {
  for (std::size_t first = 0; first < most_packet_rays; first += LaneNumbers::count) {
    if ((rays.rays >> first & lanes_mask<LaneNumbers::count>) == 0) continue;
    const auto load = [first](const std::array<RayPacket::Row, 3>& rows) HWY_ATTR {
      return LaneVec3(LaneNumbers::load(rows[0] + first), LaneNumbers::load(rows[1] + first),
                      LaneNumbers::load(rows[2] + first));
    };
    const LaneNumbers face = rays.on_face != nullptr ? LaneNumbers::load(rays.on_face + first) : LaneNumbers(-1);
    const MappedLine<LaneVec3> mapped =
        MapLine(map, load(rays.origin), load(rays.direction), tolerance, face >= LaneNumbers(0));
    const auto store = [first](const LaneVec3& v, std::array<LocalRayPacket::Numbers, 3>& rows) HWY_ATTR {
      for (int axis = 0; axis < 3; ++axis) v[axis].store(rows[static_cast<std::size_t>(axis)].data() + first);
    };
    mapped.shift.store(local.shift.data() + first);
    store(mapped.origin, local.origin);
    store(mapped.direction, local.direction);
    store(mapped.origin_error, local.origin_error);
    store(mapped.direction_error, local.direction_error);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(MapPacket);

void Placement::to_local(const RayPacket& rays, double tolerance, LocalRayPacket& local) const {
  local.rays = rays.rays;
  local.near = rays.near;
  local.on_face = rays.on_face;
  HWY_DYNAMIC_DISPATCH(MapPacket)(map_, rays, tolerance, local);
}

}  // namespace tenon
#endif
