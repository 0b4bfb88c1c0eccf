#pragma once

#include <optional>
#include <span>

#include "math/vec2.h"
#include "primitive/local_box.h"
#include "primitive/outline_edges.h"

namespace tenon {

/// n·p <= d in the plane, n of length 1.
struct HalfPlane {
  Vec2 normal;
  double d = 0;
};

/// The intersection of half-planes, as many as edges were given, and whether it is solid or a notch.
struct Wedge {
  std::array<HalfPlane, 4> sides;
  bool is_solid = true;
};

/// What straight edges of an outline bound within a box, where that, or what it leaves of the box, is convex.
///
/// It is if no edge leaves the half-plane of another, all of an edge's line that lies in the box and in the other
/// half-planes belongs to the edge, and the outline has one side between the edges and the other beyond each: then the
/// half-planes' intersection and the outline have the same boundary there.
///
/// @param walls  edges, by their numbers: all that go through the box as seen along z; none is an arc
/// @return none where neither is convex, or that cannot be told for certain
std::optional<Wedge> find_wedge(const OutlineEdges& edges, std::span<const std::uint32_t> walls, const LocalBox& box);

}  // namespace tenon
