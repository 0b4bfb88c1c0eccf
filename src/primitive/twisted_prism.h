#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "primitive/capsule.h"
#include "primitive/concept.h"
#include "primitive/edge_crossings.h"
#include "primitive/outline_edges.h"
#include "primitive/wall_part.h"

namespace tenon {

class TwistedLine;

/// An outline swept along z that turns and is scaled evenly on the way: at the share s of its height a point is
/// S(s) R(-twist s) (u, v), with (u, v) in the outline, R a turn counterclockwise, and S scaling by 1 + (scale_x - 1) s
/// and 1 + (scale_y - 1) s. So OpenSCAD has it, between whose slices this is the limit of ever more.
class TwistedPrism {
 public:
  Outline outline{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}};
  double h = 1;
  bool center = false;
  double twist = 0;
  double scale_x = 1;
  double scale_y = 1;

  static constexpr std::string_view name = "twisted_prism", scad_name = "twisted_prism";
  static constexpr std::string_view doc =
      "An outline of segments and arcs, swept along z while it turns and is scaled.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 60;
  static constexpr auto fields() {
    return std::tuple{
        Field{"outline", Unit::length, &TwistedPrism::outline, "closed loops of corners [x, y] or [x, y, bulge]"},
        Field{"h", Unit::length, &TwistedPrism::h, "height"},
        Field{"center", Unit::none, &TwistedPrism::center, "around z = 0 instead of above it"},
        Field{"twist", Unit::none, &TwistedPrism::twist, "degrees that the top is turned clockwise"},
        Field{"scale_x", Unit::none, &TwistedPrism::scale_x, "size of the top along x, relative to the bottom"},
        Field{"scale_y", Unit::none, &TwistedPrism::scale_y, "the same along y"}};
  }
  /// The walls follow, two faces an edge (face_of_edge).
  enum Face : std::uint32_t { bottom, top, walls };

  void prepare();
  std::string check() const;

  double low() const { return center ? -0.5 * h : 0; }
  double high() const { return center ? 0.5 * h : h; }

  double support(const Vec3& n) const;
  void spans(const LocalRay& ray, Spans& out) const { spans_within(ray, {}, out); }
  void spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const;
  static double window_share() { return 0.1; }
  std::optional<Crossing> crossing_near(const LocalRay& ray, double t, double near, bool entering) const;
  Region classify(const LocalBox& box) const;
  std::uint32_t face_count() const { return walls + 2 * static_cast<std::uint32_t>(edges_.edges().size()); }
  Vec3 normal(const Vec3& point, std::uint32_t face) const;
  bool walls_within(const LocalBox& box, std::size_t most, TwistedPart& part) const;

 private:
  /// What is known of the parts of a box looked at so far.
  struct BoxSearch {
    int parts_left = 32;
    bool is_inside_somewhere = false, is_outside_somewhere = false;

    void look(bool is_inside) { (is_inside ? is_inside_somewhere : is_outside_somewhere) = true; }
    bool is_decided() const { return is_inside_somewhere && is_outside_somewhere; }
  };

  /// A part of the outline's plane. Where a scale may be zero, nothing is known but the scales.
  struct Cover : Capsule {
    double far = HUGE_VAL;  ///< no place of it is farther from the axis
    double least_scale = 0, most_scale = 0;
  };

  bool find_part(const LocalRay& ray, Chord& slab, SearchedPart& whole) const;
  TwistedLine line_along(const LocalRay& ray) const;
  Cover cover(const Box3& box, double from, double to) const;
  Region classify(const Box3& bounds) const;
  Region classify_parts(const Vec3& middle, const std::array<Vec3, 3>& half_edges, const Vec3& error, int halvings,
                        BoxSearch& search) const;
  void drop_chords_beyond_tip(const LocalRay& ray, std::size_t first, Spans& out) const;
  bool find_place(const Vec3& p, Vec2& place) const;
  bool contains(const Vec3& p) const;
  double largest_scale() const { return std::max({1.0, scale_x, scale_y}); }
  double least_scale() const { return std::min({1.0, scale_x, scale_y}); }

  OutlineEdges edges_;
  double reach_ = 0;      // no point lies farther from the axis
  double clearance_ = 0;  // no wall comes nearer to it
};

}  // namespace tenon
