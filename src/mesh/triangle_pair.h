#pragma once

#include <array>
#include <optional>
#include <span>

#include "math/vec2.h"
#include "tenon/math/vec3.h"

namespace tenon {

using Triangle = std::array<Vec3, 3>;
using Segment = std::array<Vec3, 2>;

/// On which side of a triangle's plane three points lie: 1 where its normal points, -1 behind, 0 in the plane.
using Sides = std::array<int, 3>;

/// All predicates here are exact (orientation).

/// A plane seen along the coordinate axis on which it does not stand upright.
class FlatView {
 public:
  /// @return nothing for a triangle without area
  static std::optional<FlatView> of(const Triangle& t);

  Vec2 operator()(const Vec3& p) const { return {p[across_[0]], p[across_[1]]}; }
  /// Of three points of the plane: 1, -1, or 0 where they lie on one line.
  int turn(const Vec3& a, const Vec3& b, const Vec3& c) const;

 private:
  std::array<int, 2> across_{};
};

/// Whether the insides of two triangles, not in one plane, pass through one another (Guigue & Devillers, "Fast and
/// Robust Triangle-Triangle Overlap Test Using Orientation Predicates", 2003; here for segments of any length but
/// zero).
/// @param of_b  where the corners of b lie by a
/// @param of_a  where those of a lie by b
bool pass_through(const Triangle& a, const Triangle& b, const Sides& of_b, const Sides& of_a);

/// Whether a line along an edge of one of two triangles in one plane has the other beyond it, or on it in a point.
bool are_apart(const Triangle& a, const Triangle& b, const FlatView& view);

/// Whether the insides of two triangles in one plane overlap.
bool overlap(const Triangle& a, const Triangle& b, const FlatView& view);

/// Whether a part of a segment lies inside a triangle whose plane it lies in.
bool runs_inside(const Segment& s, const Triangle& t, const FlatView& view);

/// Whether two segments in one plane have more than a point in common, and lie on one line.
bool run_along(const Segment& a, const Segment& b, const FlatView& view);

/// About the middle of what a convex polygon, or a segment, has in common with a triangle, whose plane it lies in.
Vec3 common_place(std::span<const Vec3> polygon, const Triangle& t);

/// About the middle of what two triangles that pass through one another have in common.
Vec3 common_place(const Triangle& a, const Triangle& b);

}  // namespace tenon
