#pragma once

#include <cstdint>

#include "primitive/local_box.h"
#include "primitive/local_ray.h"
#include "tenon/math/vec3.h"
#include "tenon/primitive/crossing.h"

namespace tenon {

/// A solid made of other solids, where a primitive may stand. It promises what every primitive does (SolidPrimitive).
class CompositeSolid {
 public:
  virtual ~CompositeSolid() = default;

  virtual double support(const Vec3& n) const = 0;
  virtual void spans(const LocalRay& ray, Spans& out) const = 0;
  virtual Region classify(const LocalBox& box) const = 0;
  virtual Vec3 normal(const Vec3& point, std::uint32_t face) const = 0;
  virtual std::uint32_t face_count() const = 0;
};

}  // namespace tenon
