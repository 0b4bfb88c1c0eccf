#include "primitive/mesh_line.h"

#include "primitive/mesh_line-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {

MeshLine::MeshLine(const LocalRay& ray, const Box3& bounds) {
  const Vec3 size = abs(ray.direction);
  along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  HWY_NAMESPACE::SetLine(ray.origin, ray.direction, ray.origin_error, ray.direction_error, bounds, *this);
}

FloatLine::FloatLine(const MeshLine& line, const LineWindow& window, const MeshBvh::Frame& frame)
    : FloatLine(HWY_NAMESPACE::FrameLine(line, frame), line.along, line.direction[line.along] > 0, window) {}

}  // namespace tenon
HWY_AFTER_NAMESPACE();
