#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "plane/shape.h"
#include "primitive/arc.h"
#include "primitive/outline_edges.h"

namespace tenon {

/// How far a point lies from the segments and arcs of an outline.
inline double distance_to_boundary(const OutlineEdges& edges, const Vec2& p) {
  double least = HUGE_VAL;
  for (const OutlineEdge& edge : edges.edges()) {
    const Vec2 w = edge.chord(), q = p - edge.from;
    least = std::min({least, length(q), length(p - edge.to)});
    if (edge.is_arc()) {
      const Circle circle = circle_of_arc(edge.from, edge.to, edge.bulge);
      const Vec2 arm = p - circle.center;
      if (!(length(arm) > 0)) continue;
      const Vec2 foot = circle.center + circle.radius / length(arm) * arm;
      if (edge.side(foot - edge.from) > 0) least = std::min(least, std::fabs(length(arm) - circle.radius));
    } else if (dot(q, w) > 0 && dot(q, w) < dot(w, w)) {
      least = std::min(least, std::fabs(cross(w, q)) / length(w));
    }
  }
  return least;
}

/// Max n·p over the points of an outline.
inline double support(const OutlineEdges& edges, const Vec2& n) {
  double greatest = -HUGE_VAL;
  for (const OutlineEdge& edge : edges.edges()) {
    greatest = std::max(greatest, dot(n, edge.from));
    if (!edge.is_arc()) continue;
    const Circle circle = circle_of_arc(edge.from, edge.to, edge.bulge);
    const Vec2 farthest = circle.center + circle.radius / length(n) * n;
    if (edge.side(farthest - edge.from) > 0) greatest = std::max(greatest, dot(n, farthest));
  }
  return greatest;
}

/// Points close by, on both sides of every edge of an outline, and of others.
inline std::vector<Vec2> points_beside(const Outline& outline, double distance) {
  std::vector<Vec2> points;
  const OutlineEdges edges(outline);
  for (const OutlineEdge& edge : edges.edges()) {
    const Vec2 middle = middle_of_arc(edge.from, edge.to, edge.bulge), w = edge.chord();
    if (!(length(w) > 4 * distance)) continue;
    const Vec2 n = distance / length(w) * Vec2{w.y, -w.x};
    points.push_back(middle + n);
    points.push_back(middle - n);
  }
  return points;
}

/// The bounds of what a shape is made of.
inline double size_of(const Shape& shape) {
  double size = 0;
  if (!shape.outline.loops.empty()) size = length(OutlineEdges(shape.outline).reach());
  for (const Shape& part : shape.parts) size = std::max(size, size_of(part));
  return size;
}

}  // namespace tenon
