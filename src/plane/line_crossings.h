#pragma once

#include <vector>

#include "math/vec2.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// A line of the plane: the points p with dot(normal, p) = distance.
struct PlaneLine {
  Vec2 normal;  ///< of length 1
  double distance = 0;

  /// How far a point lies on the side that the normal points to.
  double side(const Vec2& p) const { return dot(normal, p) - distance; }
  /// The direction in which positions on the line are counted, from the foot of the origin: a quarter of a turn to the
  /// left of the normal.
  Vec2 along() const { return {-normal.y, normal.x}; }
  Vec2 point(double position) const { return distance * normal + position * along(); }
};

/// Where a line enters and leaves what an outline encloses, in turns: positions on the line, in order.
///
/// What lies on the line, or within `same_place` of it, counts as behind it, as if the line were moved to the side of
/// its normal by next to nothing: so a straight part of the outline along the line belongs to what lies before it.
std::vector<double> line_crossings(const Outline& outline, const PlaneLine& line, double same_place);

}  // namespace tenon
