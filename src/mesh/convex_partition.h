#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "mesh/convex_cell.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// Cuts a polyhedron that need not be convex into disjoint convex ones, by planes of its walls, until none passes
/// through a part (Fuchs, Kedem, Naylor, "On visible surface generation by a priori tree structures", 1980). What is
/// whole again when its parts are put together stays whole.
/// @param whole       holds the polyhedron; its faces need no walls
/// @param walls       convex
/// @param is_inside   whether a place that is on no wall lies within the polyhedron
/// @param same_place  what lies no further from a plane lies in it
/// @param most        parts
/// @return nothing where there would be more parts
std::optional<std::vector<ConvexCell>> convex_partition(const ConvexCell& whole, std::vector<FlatPolygon> walls,
                                                        const std::function<bool(const Vec3&)>& is_inside,
                                                        double same_place, std::size_t most);

/// How often triangles that close wind around a place, unrounded: the solid angles under which they are seen (Van
/// Oosterom, Strackee, "The solid angle of a plane triangle", 1983).
double winding_around(const Vec3& place, const std::vector<Vec3>& points,
                      const std::vector<TriangleMesh::Corners>& triangles);

}  // namespace tenon
