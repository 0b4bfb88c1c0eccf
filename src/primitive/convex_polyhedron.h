#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "primitive/half_space.h"

namespace tenon {

/// The points on the inner side of every plane.
class ConvexPolyhedron {
 public:
  std::vector<Plane> planes{{{-1, 0, 0}, 0}, {{1, 0, 0}, 1},  {{0, -1, 0}, 0},
                            {{0, 1, 0}, 1},  {{0, 0, -1}, 0}, {{0, 0, 1}, 1}};

  static constexpr std::string_view name = "convex_polyhedron", scad_name = "convex_polyhedron";
  static constexpr std::string_view doc = "The intersection of half-spaces normal·p <= d; it must be bounded.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 1.9;
  static constexpr auto fields() {
    return std::tuple{Field{"planes", Unit::none, &ConvexPolyhedron::planes, "normal and d of each half-space"}};
  }

  /// Finds the vertices: once, in O(planes³).
  void prepare();
  std::string check() const { return problem_; }

  /// Where three planes or more meet; the same place may occur more than once, off by rounding.
  const std::vector<Vec3>& vertices() const { return vertices_; }

  double support(const Vec3& n) const {
    double greatest = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : vertices_) greatest = std::max(greatest, dot(n, v));
    return greatest + slack_ * length(n);
  }

  /// Faces: the planes, by index.
  void spans(const LocalRay& ray, Spans& out) const {
    Chord chord;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const BoundedLine line = plane_along(ray, planes[i].normal, planes[i].d);
      if (!clip_half_space(line, static_cast<std::uint32_t>(i), ray.on_face == static_cast<int>(i), chord)) return;
      if (chord.enter.lo > chord.leave.hi) return;
    }
    emit_chord(chord, out);
  }

  Region classify(const LocalBox& box) const {
    bool inside = true;
    for (const Plane& plane : planes) {
      const Extent extent = extent_along(box, plane.normal);
      if (extent.least() > plane.d) return Region::outside;
      inside = inside && extent.greatest() <= plane.d;
    }
    if (inside) return Region::inside;
    return is_separated_by_box_faces(box, *this) ? Region::outside : Region::straddles;
  }

  std::uint32_t face_count() const { return static_cast<std::uint32_t>(planes.size()); }
  Vec3 normal(const Vec3&, std::uint32_t face) const { return planes[face].normal; }

 private:
  std::string check_volume(const std::vector<Plane>& unit_planes) const;

  std::vector<Vec3> vertices_;
  double slack_ = 0;  // bound on the error of a vertex
  std::string problem_ = "convex_polyhedron is not prepared";
};

}  // namespace tenon
