#pragma once

#include <limits>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/clip.h"
#include "primitive/concept.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// normal·p - d along a line, with errors: those of the line, and the roundings of the two sums.
inline BoundedLine plane_along(const LocalRay& ray, const Vec3& normal, double d) {
  const Vec3 n = abs(normal);
  return {dot(normal, ray.origin) - d, dot(normal, ray.direction),
          dot(n, ray.origin_error) + gamma(4) * (dot(n, abs(ray.origin)) + std::fabs(d)),
          dot(n, ray.direction_error) + gamma(4) * dot(n, abs(ray.direction))};
}

/// normal·p <= d.
struct HalfSpace {
  Vec3 plane_normal{0, 0, 1};
  double d = 0;

  static constexpr std::string_view name = "halfspace", scad_name = "halfspace";
  static constexpr std::string_view doc = "All points p with normal·p <= d; unbounded.";
  static constexpr bool bounded = false;
  static constexpr double relative_cost = 0.9;
  static constexpr auto fields() {
    return std::tuple{Field{"normal", Unit::none, &HalfSpace::plane_normal, "outward normal of its face, any length"},
                      Field{"d", Unit::length, &HalfSpace::d, "normal·p on its face"}};
  }

  std::string check() const {
    const std::string problem = check_lengths(name, {{"|normal|", max_component(abs(plane_normal))}});
    if (!problem.empty()) return problem;
    return check_lengths(name, {{"|d|", std::fabs(d), true}});
  }

  /// Bounded only along the normal; sums in the cross product are exact where n is a multiple of an axis.
  double support(const Vec3& n) const {
    if (n == Vec3{}) return 0;
    const double along = dot(n, plane_normal);
    if (cross(n, plane_normal) != Vec3{} || along < 0) return std::numeric_limits<double>::infinity();
    return d * along / dot(plane_normal, plane_normal);
  }

  void spans(const LocalRay& ray, Spans& out) const {
    Chord chord;
    if (clip_half_space(plane_along(ray, plane_normal, d), 0, ray.on_face == 0, chord)) emit_chord(chord, out);
  }

  Region classify(const LocalBox& box) const {
    const Extent extent = extent_along(box, plane_normal);
    if (extent.greatest() <= d) return Region::inside;
    return extent.least() > d ? Region::outside : Region::straddles;
  }

  std::uint32_t face_count() const { return 1; }
  Vec3 normal(const Vec3&, std::uint32_t) const { return plane_normal; }
};

}  // namespace tenon
