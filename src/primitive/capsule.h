#pragma once

#include <cmath>

#include "primitive/outline_edges.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// What of a plane lies within `spread` of a segment, the places place + s way for s from -1 to 1.
struct Capsule {
  Vec2 place, way;
  double spread = 0;

  bool may_touch(const Vec2& lower, const Vec2& upper) const {
    const double x = std::fabs(way.x) + spread, y = std::fabs(way.y) + spread;
    return place.x - x <= upper.x && lower.x <= place.x + x && place.y - y <= upper.y && lower.y <= place.y + y;
  }

  /// Whether an edge's line or circle may go through it: q(p + v) = q(p) + grad q(p)·v + bulge v².
  bool may_cross(const OutlineEdge& edge) const {
    const Vec2 p = place - edge.from, normal = edge.normal(p);
    const double moved = length(way) + spread, from = length(p), chord = length(edge.chord());
    const double change = std::fabs(dot(normal, way)) + length(normal) * spread + std::fabs(edge.bulge) * moved * moved;
    // Of q, of its gradient and of the terms above; that of p and the chord is part of the spread.
    const double rounding =
        gamma(16) * (from * (std::fabs(edge.bulge) * (from + chord) + std::fabs(edge.flatness()) * chord) +
                     edge.steepness(from) * moved + change);
    return std::fabs(edge.value(p)) <= change + rounding;
  }

  /// Calls visit(index of an edge) for those that may go through it, until it returns false.
  template <class Visit>
  bool visit_edges(const OutlineEdges& edges, const Visit& visit) const {
    const auto touches = [this](const Vec2& lower, const Vec2& upper) { return may_touch(lower, upper); };
    return edges.visit_edges(touches, [&](std::uint32_t i) { return !may_cross(edges.edges()[i]) || visit(i); });
  }
};

}  // namespace tenon
