#pragma once

#include <string>
#include <vector>

#include "math/vec2.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// A segment or an arc of an outline, as an implicit curve: on its line or circle
///
///   q(p) = bulge (p - from)·(p - to) - (1 - bulge²)/2 cross(to - from, p - from)
///
/// is zero, and it grows to the right of the way from `from` to `to`. No centre occurs, so that a flat arc is known as
/// well as a segment.
struct OutlineEdge {
  Vec2 from, to;
  double bulge = 0;
  Vec2 lower, upper;  ///< a box around it

  /// With the box around it.
  static OutlineEdge between(const Vec2& from, const Vec2& to, double bulge);

  bool is_arc() const { return bulge != 0; }
  Vec2 chord() const { return to - from; }
  Vec2 middle_of_chord() const { return from + 0.5 * chord(); }
  /// The factor of the cross product, to a few roundings of itself.
  double flatness() const { return 0.5 * (1 - bulge) * (1 + bulge); }
  /// q at a point given relative to `from`.
  double value(const Vec2& p) const {
    const Vec2 w = chord();
    return bulge * dot(p, p - w) - flatness() * cross(w, p);
  }
  /// The gradient of q there: to the right, outward where the outline turns to the left.
  Vec2 normal(const Vec2& p) const {
    const Vec2 w = chord();
    return bulge * (2 * p - w) + flatness() * Vec2{w.y, -w.x};
  }
  /// Over the length of the gradient on the line or circle, so that it is about the distance near there.
  double distance(const Vec2& p) const { return value(p) / gradient_length(); }
  double gradient_length() const { return 0.5 * length(chord()) * (1 + bulge * bulge); }
  /// Bound on the length of the gradient within a distance of `from`.
  double steepness(double distance) const {
    const double w = length(chord());
    return std::fabs(bulge) * (2 * distance + w) + std::fabs(flatness()) * w;
  }
  /// Of a point of the circle, whether it lies on the arc: positive on the arc's side of the chord.
  double side(const Vec2& p) const { return bulge > 0 ? -cross(chord(), p) : cross(chord(), p); }
};

/// The edges of an outline with a hierarchy of boxes over them, so that a query looks at few of many.
class OutlineEdges {
 public:
  OutlineEdges() = default;
  explicit OutlineEdges(const Outline& outline);

  const std::vector<OutlineEdge>& edges() const { return edges_; }
  const Vec2& lower() const { return nodes_.front().lower; }
  const Vec2& upper() const { return nodes_.front().upper; }
  /// The largest |coordinate| of the boxes, per axis.
  Vec2 reach() const { return max(abs(lower()), abs(upper())); }

  /// Whether a point lies inside; of one nearer to an edge than its own rounding either may be said.
  bool contains(const Vec2& p) const;
  /// Whether a point lies within a distance of an edge; may say so a little further away.
  bool is_near_edge(const Vec2& p, double distance) const;
  /// Max n·p over the points of the outline, rounded up.
  double support(const Vec2& n) const;

  /// Calls visit(index of an edge) for the edges whose boxes, and those of the groups around them, pass
  /// touches(lower, upper), until it returns false.
  template <class Touches, class Visit>
  bool visit_edges(const Touches& touches, const Visit& visit) const {
    if (order_.empty()) return true;
    std::uint32_t stack[64];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const Node& node = nodes_[stack[--size]];
      if (nodes_.size() > 1 && !touches(node.lower, node.upper)) continue;
      if (node.count == 0) {
        stack[size++] = node.first;
        stack[size++] = node.first + 1;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const OutlineEdge& edge = edges_[order_[i]];
        if (touches(edge.lower, edge.upper) && !visit(order_[i])) return false;
      }
    }
    return true;
  }

 private:
  struct Node {
    Vec2 lower, upper;
    std::uint32_t first = 0;  // its first edge in order_, or its first child; the other one follows
    std::uint32_t count = 0;  // of edges; 0 for an inner node
  };

  void build(std::size_t node, std::uint32_t first, std::uint32_t count);
  void find_extreme_points();

  std::vector<OutlineEdge> edges_;    // in the order of the outline
  std::vector<std::uint32_t> order_;  // of those with a length
  std::vector<Node> nodes_ = std::vector<Node>(1);
  std::vector<Vec2> extreme_points_;  // the convex hull of the corners
  std::vector<std::uint32_t> round_;  // arcs that may reach beyond it
};

/// Why an outline makes no solid; empty when it will do.
/// @param kind  the primitive it belongs to
std::string check_outline(std::string_view kind, const Outline& outline);

}  // namespace tenon
