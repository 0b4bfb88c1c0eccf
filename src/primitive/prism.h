#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "primitive/concept.h"
#include "primitive/edge_crossings.h"
#include "primitive/outline_edges.h"
#include "primitive/wall_part.h"

namespace tenon {

/// An outline swept along z, growing or shrinking evenly on the way: (x, y) / s(z) lies in the outline, and s goes from
/// 1 at the bottom to `scale` at the top.
class Prism {
 public:
  Outline outline{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
  double h = 1;
  bool center = false;
  double scale = 1;

  static constexpr std::string_view name = "prism", scad_name = "prism";
  static constexpr std::string_view doc = "An outline of segments and arcs, swept along z.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 7;
  /// The deeper the hierarchy over the edges, the longer. By trial on OpenSCAD's surface_image.
  double own_cost() const { return relative_cost + std::log2(1 + static_cast<double>(edges().size()) / 16); }
  static constexpr auto fields() {
    return std::tuple{
        Field{"outline", Unit::length, &Prism::outline, "closed loops of corners [x, y] or [x, y, bulge]"},
        Field{"h", Unit::length, &Prism::h, "height"},
        Field{"center", Unit::none, &Prism::center, "around z = 0 instead of above it"},
        Field{"scale", Unit::none, &Prism::scale, "size of the top relative to the bottom; 0 makes a tip"}};
  }
  /// The walls follow, two faces an edge (face_of_edge).
  enum Face : std::uint32_t { bottom, top, walls };

  void prepare() { edges_ = check().empty() ? OutlineEdges(outline) : OutlineEdges(); }
  std::string check() const;

  const std::vector<OutlineEdge>& edges() const { return edges_.edges(); }
  double low() const { return center ? -0.5 * h : 0; }
  double high() const { return center ? 0.5 * h : h; }

  double support(const Vec3& n) const {
    const double across = edges_.support({n.x, n.y});
    return std::max(across + n.z * low(), scale * across + n.z * high());
  }
  void spans(const LocalRay& ray, Spans& out) const { spans_within(ray, {}, out); }
  void spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const;
  static double window_share() { return 0.15; }
  std::optional<Crossing> crossing_near(const LocalRay& ray, double t, double near, bool entering) const;
  Region classify(const LocalBox& box) const;
  std::uint32_t face_count() const { return walls + 2 * static_cast<std::uint32_t>(edges().size()); }
  Vec3 normal(const Vec3& point, std::uint32_t face) const;
  PlanarPart planes_within(const LocalBox& box, std::vector<Plane>& planes) const;
  bool walls_within(const LocalBox& box, std::size_t most, SweptPart& part) const;

 private:
  class Line;

  double slope() const { return (scale - 1) / h; }
  double scale_at(double z) const { return 1 + (z - low()) * slope(); }
  Vec3 point_between_caps(const LocalBox& box) const;
  template <class Visit>
  bool visit_walls(const LocalBox& box, double least_scale, double most_scale, const Visit& visit) const;
  bool lies_beyond(const LocalBox& box, const Vec2& n, const Vec2& v) const;
  bool may_touch(const LocalBox& box, const OutlineEdge& edge) const;

  OutlineEdges edges_;
};

}  // namespace tenon
