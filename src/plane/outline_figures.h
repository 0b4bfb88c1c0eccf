#pragma once

#include <algorithm>

#include "primitive/outline_edges.h"

namespace tenon {

/// Bound on the |coordinates| of an outline.
inline double largest_coordinate(const Outline& outline) {
  const OutlineEdges edges(outline);
  return edges.edges().empty() ? 0 : std::max(edges.reach().x, edges.reach().y);
}

inline bool has_arcs(const Outline& outline) {
  return std::any_of(outline.loops.begin(), outline.loops.end(), [](const auto& loop) {
    return std::any_of(loop.begin(), loop.end(), [](const OutlineCorner& corner) { return corner.bulge != 0; });
  });
}

}  // namespace tenon
