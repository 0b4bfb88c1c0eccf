#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "primitive/clip.h"
#include "tenon/base/function_ref.h"

namespace tenon {

/// Where a line may cross an edge of a swept outline.
struct EdgeCrossing : BoundedRoot {
  std::uint32_t edge = 0;
  bool rising = false;  ///< towards the side that the edge's normal points to
  bool sure = false;    ///< the exact line crosses this edge, once, within the interval; else it may or may not
  bool given = false;   ///< the face the ray starts on: at exactly t = 0, and lookups cannot tell within the interval

  /// Of the edge whose wall the ray starts on.
  /// @param doubt       how far from there lookups may still take the wrong side ...
  /// @param begin, end  ... where the line is over the edge's box; beyond none does
  static EdgeCrossing at_start(std::uint32_t edge, bool rising, double doubt, double begin, double end) {
    return {{0, std::max(-doubt, std::min(begin, 0.0)), std::min(doubt, std::max(end, 0.0))}, edge, rising, true, true};
  }
};

/// How far from t = 0 a function that is zero there, slope t ± half_curvature t², may be within an error of zero; in
/// the middle of what is left up to its other root it is not.
inline double doubt_around_zero(double slope, double half_curvature, double error) {
  if (!(error > 0)) return 0;
  const double b = std::fabs(slope), a = std::fabs(half_curvature);
  // At 2 E / b it is at least 2 E - 4 a E² / b², and in the middle between there and b / a as much, which is more than
  // E; and where that is not said, at 3 √(E / a) it is at least 9 E - 3 √5 E.
  return 5 * a * error <= b * b ? 2 * error / b : 3 * std::sqrt(error / a);
}

/// The part of a line that was searched for crossings.
struct SearchedPart {
  double begin = 0, end = 0;
  bool outside_before = false, outside_after = false;  ///< known of the line right before and behind it

  bool is_empty() const { return !(begin <= end); }
  /// What of it lies within a window.
  SearchedPart within(const LineWindow& window) const {
    return {std::max(begin, window.begin), std::min(end, window.end), outside_before && begin >= window.begin,
            outside_after && end <= window.end};
  }
};

/// One crossing of the outline's boundary.
struct BoundaryCrossing {
  End end;
  bool entering = false;
};

/// Finds which crossings of edges are crossings of the boundary of the region that the edges enclose by the even-odd
/// rule.
///
/// The exact line crosses edges within the intervals of `crossings` alone, so between intervals it is certainly inside
/// or outside. Where all crossings of a cluster of intervals are sure, their parity tells what lies behind it. Where
/// one is not (the line passes a corner nearer than the errors), a point of the gap behind the cluster is looked up,
/// and the cluster becomes one crossing, or a pair, with the whole cluster for an interval.
///
/// @param crossings  in any order; sorted here
/// @param is_inside  whether the line is inside at t; asked in gaps only, where there are any
/// @param found      the crossings in order, alternating
/// @return whether the line is inside at the beginning of the part
bool find_boundary_crossings(std::vector<EdgeCrossing>& crossings, const SearchedPart& part,
                             FunctionRef<bool(double)> is_inside, std::vector<BoundaryCrossing>& found);

/// Reports the parts of a swept outline between its caps.
///
/// @param slab        the part of the line between the caps
/// @param boundary    the crossings of the outline's boundary, in order
/// @param inside      whether the line is inside of the outline before the first of them
/// @param first_wall  is added to the numbers of their faces
void emit_between_caps(const Chord& slab, const std::vector<BoundaryCrossing>& boundary, bool inside,
                       std::uint32_t first_wall, Spans& out);

/// The crossing of a swept outline that is within `near` of t, if it is certainly the only one within twice that; of a
/// line whose part within the solid is longer than that.
///
/// @param slab        the part of the line between the caps
/// @param crossings   with edges, all of those that may be one with it
/// @param first_wall  is added to the numbers of their faces
std::optional<Crossing> crossing_between_caps(const Chord& slab, std::span<const EdgeCrossing> crossings, double t,
                                              double near, bool entering, std::uint32_t first_wall);

/// The number of a face of a swept outline: its edge, and whether the solid lies on the side that the edge's normal
/// points to. By the even-odd rule that may differ along one edge.
inline std::uint32_t face_of_edge(std::uint32_t edge, bool rising, bool entering) {
  return 2 * edge + (rising == entering ? 1U : 0U);
}

}  // namespace tenon
