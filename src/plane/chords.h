#pragma once

#include <polyclipping/clipper.hpp>
#include <unordered_map>
#include <vector>

#include "primitive/arc.h"
#include "primitive/outline_edges.h"

namespace tenon {

/// A segment or an arc that an outline is made of, with the circle of the arc.
struct Curve {
  Vec2 from, to;
  double bulge = 0;
  Circle circle;

  bool is_arc() const { return bulge != 0; }
};

/// Outlines as polygons on Clipper's grid of integers, and which segment or arc each edge of such a polygon is of.
///
/// Arcs become chords between the same points of their circle wherever they begin, so that arcs of one circle coincide.
/// A chord keeps nearer to its arc than 2⁻¹⁵ of the largest coordinate: curves further apart are told apart.
class Chords {
 public:
  /// Of a full circle.
  static constexpr int fewest_chords = 128;

  /// @param largest  bound on the coordinates of everything that will be added
  explicit Chords(double largest);

  /// The polygons of an outline.
  ClipperLib::Paths add(const Outline& outline);

  /// The curve that an edge is of, in a polygon that Clipper made of those added; asked after index().
  Curve curve_of(const ClipperLib::IntPoint& from, const ClipperLib::IntPoint& to) const;
  /// Whether a corner or a point of an arc of the outlines lies there.
  bool is_corner(const ClipperLib::IntPoint& p) const { return points_.contains(p); }
  /// The point of the plane; exactly that of an outline's corner, where one lies there.
  Vec2 point(const ClipperLib::IntPoint& p) const;

  /// The distance of neighbours on the grid.
  double unit() const { return unit_; }
  /// Bound on the length of a chord of this curve's; 0 for segments.
  double longest_chord(const Curve& curve) const;
  /// What lies no further apart may be one place, moved by Clipper's rounding to the grid, in units: an intersection is
  /// rounded to the next point, which moves both edges, and their next intersections with them.
  static constexpr double same_place = 8;

  /// To be called after the last add().
  void index() { edges_ = OutlineEdges(chords_); }

 private:
  struct Hash {
    std::size_t operator()(const ClipperLib::IntPoint& p) const {
      return static_cast<std::size_t>(p.X) * 0x9e3779b97f4a7c15u ^ static_cast<std::size_t>(p.Y) * 0xc2b2ae3d27d4eb4fu;
    }
  };

  ClipperLib::IntPoint to_grid(const Vec2& p);
  double step(const Circle& circle) const;
  void add_arc(const Curve& curve, std::vector<OutlineCorner>& loop) const;

  double unit_;
  double sagitta_;
  double largest_radius_;
  std::vector<Curve> curves_;
  std::size_t chord_count_ = 0;
  Outline chords_;                           // every polygon added, unrounded
  std::vector<std::size_t> curve_of_chord_;  // in the order of their edges
  OutlineEdges edges_;
  std::unordered_map<ClipperLib::IntPoint, Vec2, Hash> points_;
};

}  // namespace tenon
