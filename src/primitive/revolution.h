#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/concept.h"
#include "primitive/edge_crossings.h"
#include "primitive/outline_edges.h"
#include "primitive/wall_part.h"

namespace tenon {

/// An outline turned around z: a point is inside when (its distance from z, z) lies in the outline.
class Revolution {
 public:
  Outline outline{{{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}}};

  static constexpr std::string_view name = "revolution", scad_name = "revolution";
  static constexpr std::string_view doc = "An outline of segments and arcs, turned around z.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 17;
  static constexpr auto fields() {
    return std::tuple{Field{"outline", Unit::length, &Revolution::outline,
                            "closed loops of corners [distance from z, z] or [distance from z, z, bulge]"}};
  }

  void prepare() {
    edges_ = OutlineEdges();
    if (check_outline(name, outline).empty()) edges_ = OutlineEdges(outline);
  }
  std::string check() const;

  double support(const Vec3& n) const { return edges_.support({std::sqrt(n.x * n.x + n.y * n.y), n.z}); }
  /// Faces: two an edge (face_of_edge).
  void spans(const LocalRay& ray, Spans& out) const { spans_within(ray, {}, out); }
  void spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const;
  static double window_share() { return 0.3; }
  std::optional<Crossing> crossing_near(const LocalRay& ray, double t, double near, bool entering) const;
  Region classify(const LocalBox& box) const;
  std::uint32_t face_count() const { return 2 * static_cast<std::uint32_t>(edges_.edges().size()); }
  Vec3 normal(const Vec3& point, std::uint32_t face) const;
  bool walls_within(const LocalBox& box, std::size_t most, RevolvedPart& part) const;

 private:
  class Line;
  class MeridianBox;

  OutlineEdges edges_;
};

}  // namespace tenon
