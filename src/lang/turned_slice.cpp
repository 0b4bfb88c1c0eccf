#include "lang/turned_slice.h"

#include <cmath>

#include "lang/round_profile.h"
#include "plane/arc_corners.h"
#include "plane/line_crossings.h"
#include "plane/mapped_outline.h"
#include "plane/outline_figures.h"

namespace tenon::lang {

namespace {

// Of each place of the profile in the plane, what it goes around; the profile is the same on both sides of the axis.
Shape rings(const Outline& profile, double reach, const Affine3& map) {
  const double z = -map.m[2][3] / map.m[2][2];
  const double above = map.m[2][2] > 0 ? 1 : -1;
  Outline circles;
  for (const double position : line_crossings(profile, {{0, above}, above * z}, turn_rounding * reach)) {
    if (position > 0) circles.loops.push_back(full_circle({{0, 0}, position}, 1));
  }
  return Shape::of(mapped(circles, map * Affine3::translate({0, 0, z})));
}

// The plane holds the axis.
Shape lying_profile(const Outline& profile, const Affine3& map) {
  const double slope = std::hypot(map.m[2][0], map.m[2][1]);
  const Vec3 across = map.direction({-map.m[2][1] / slope, map.m[2][0] / slope, 0}), along = map.column(2);
  const Vec3 origin = map.translation();
  return Shape::of(
      mapped(profile, {{{{across.x, along.x, 0, origin.x}, {across.y, along.y, 0, origin.y}, {0, 0, 1, 0}}}}));
}

}  // namespace

std::optional<Shape> slice_of_turned(const UnionLeaf& leaf) {
  const auto full = full_profile(leaf);
  if (!full) return std::nullopt;
  const Outline profile = resolve(*full);
  const double reach = largest_coordinate(profile);
  const double tilt = std::hypot(leaf.map.m[2][0], leaf.map.m[2][1]), steepness = std::fabs(leaf.map.m[2][2]);
  if (tilt <= turn_rounding * steepness) return rings(profile, reach, leaf.map);
  const double off = steepness * reach + std::fabs(leaf.map.m[2][3]);
  if (off <= turn_rounding * tilt * reach) return lying_profile(profile, leaf.map);
  return std::nullopt;
}

}  // namespace tenon::lang
