#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/composite_solid.h"

namespace tenon {

using SharedSolid = std::shared_ptr<const CompositeSolid>;

/// A solid that stands at many places and is stored once. It is no kind of the scene language: PrimitiveStore::kinds()
/// does not list it.
class Instance {
 public:
  SharedSolid solid;

  static constexpr std::string_view name = "instance", scad_name = {};
  static constexpr std::string_view doc = "A solid that stands at many places and is stored once.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 20;
  static constexpr auto fields() { return std::tuple{}; }

  std::string check() const { return {}; }
  double support(const Vec3& n) const { return solid->support(n); }
  void spans(const LocalRay& ray, Spans& out) const { solid->spans(ray, out); }
  Region classify(const LocalBox& box) const { return solid->classify(box); }
  Vec3 normal(const Vec3& point, std::uint32_t face) const { return solid->normal(point, face); }
  std::uint32_t face_count() const { return solid->face_count(); }
};

}  // namespace tenon
