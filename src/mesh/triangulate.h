#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tenon/math/vec3.h"

namespace tenon {

/// Cuts a polygon, which need not be convex, into triangles, as if it were flat, by clipping ears (Meisters, "Polygons
/// have ears", 1975). Corners in a row on one line are kept, so that the edges are those of the polygon.
///
/// @param corners  into `points`; at least three
/// @param out      receives one triangle less than two corners, oriented as the polygon is
/// @return how far a corner lies from the polygon's plane, at most, relative to its largest coordinate
double triangulate(std::span<const std::uint32_t> corners, const std::vector<Vec3>& points,
                   std::vector<std::array<std::uint32_t, 3>>& out);

}  // namespace tenon
