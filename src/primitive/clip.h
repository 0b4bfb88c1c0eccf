#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "math/bounded_root.h"
#include "primitive/local_ray.h"
#include "tenon/math/rounding.h"
#include "tenon/primitive/crossing.h"

namespace tenon {

/// One end of a chord: where the line meets a face.
struct End : BoundedRoot {
  std::uint32_t face = 0;
  bool given = false;  ///< the face the ray starts on: known to be at exactly t = 0

  bool may_be_at(double other) const { return lo <= other && other <= hi; }
};

/// The part of the line inside a convex solid, or inside a convex part of one.
struct Chord {
  End enter{{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
             -std::numeric_limits<double>::infinity()},
            0};
  End leave{{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity()},
            0};
};

/// The later of two entrances. Its interval contains the exact maximum whichever face that belongs to; an exact end
/// (the face the ray starts on) stands for every other that may lie there too.
inline End later(const End& a, const End& b) {
  if (a.given && b.may_be_at(a.t)) return a;
  if (b.given && a.may_be_at(b.t)) return b;
  End end = a.t >= b.t ? a : b;
  end.lo = std::max(a.lo, b.lo);
  end.hi = std::max(a.hi, b.hi);
  return end;
}

/// The earlier of two exits; see later().
inline End earlier(const End& a, const End& b) {
  if (a.given && b.may_be_at(a.t)) return a;
  if (b.given && a.may_be_at(b.t)) return b;
  End end = a.t <= b.t ? a : b;
  end.lo = std::min(a.lo, b.lo);
  end.hi = std::min(a.hi, b.hi);
  return end;
}

/// What is known of a linear function f(t) = value + t * slope along the exact line: errors bound both coefficients.
struct BoundedLine {
  double value = 0;
  double slope = 0;
  double value_error = 0;
  double slope_error = 0;
};

/// Where f(t) = 0: at t = -value / slope, with the interval of all quotients within the errors.
///
/// @param f        its slope is not zero within its error
/// @param on_face  the line is known to meet this plane at exactly t = 0
inline End plane_end(const BoundedLine& f, std::uint32_t face, bool on_face) {
  End end;
  end.face = face;
  end.given = on_face;
  if (on_face) return end;
  // Divided by the least and the greatest slope; each quotient takes a rounding of the divisor and two of its own.
  const double slope = std::fabs(f.slope);
  const double distance = f.slope < 0 ? f.value : -f.value;
  const double low = distance - f.value_error, high = distance + f.value_error;
  const double steep = 1 / (slope + f.slope_error), shallow = 1 / (slope - f.slope_error);
  end.t = distance / slope;
  end.lo = low * (low >= 0 ? steep : shallow);
  end.hi = high * (high >= 0 ? shallow : steep);
  end.lo -= gamma(5) * std::fabs(end.lo);
  end.hi += gamma(5) * std::fabs(end.hi);
  return end;
}

/// Cuts a chord with the half-space f(t) <= 0. Where the slope may be zero the line counts as parallel to the plane: it
/// is inside when f may be <= 0 at t = 0 (closed: a ray in the face counts as inside).
///
/// @param on_face  the line is known to meet this plane at exactly t = 0
/// @return false when the line is parallel and outside
inline bool clip_half_space(const BoundedLine& f, std::uint32_t face, bool on_face, Chord& chord) {
  if (!(std::fabs(f.slope) > f.slope_error)) return on_face || f.value <= f.value_error;
  const End end = plane_end(f, face, on_face);
  if (f.slope < 0) {
    chord.enter = later(chord.enter, end);
  } else {
    chord.leave = earlier(chord.leave, end);
  }
  return true;
}

/// Cuts a chord with the slab low <= coordinate <= high of one axis.
/// @return false when the line is parallel to the slab and outside
inline bool clip_slab(const LocalRay& ray, int axis, double low, double high, std::uint32_t low_face,
                      std::uint32_t high_face, Chord& chord) {
  const double origin = ray.origin[axis], direction = ray.direction[axis];
  const double slope_error = ray.direction_error[axis];
  // The differences take one rounding each.
  const double above = origin - high, below = low - origin;
  const double error = ray.origin_error[axis];
  return clip_half_space({above, direction, error + gamma(1) * std::fabs(above), slope_error}, high_face,
                         ray.on_face == static_cast<int>(high_face), chord) &&
         clip_half_space({below, -direction, error + gamma(1) * std::fabs(below), slope_error}, low_face,
                         ray.on_face == static_cast<int>(low_face), chord);
}

/// Cuts an interval of t with value + t slope <= 0, but for what rounds. @return whether something is left
inline bool clip_interval(double value, double slope, double& begin, double& end) {
  if (slope > 0) {
    end = std::min(end, -value / slope);
  } else if (slope < 0) {
    begin = std::max(begin, -value / slope);
  } else if (value > 0) {
    return false;
  }
  return begin <= end;
}

/// A crossing at the end of a chord. One at infinity has no error; the last factor covers the roundings of the bound
/// itself.
inline Crossing crossing_at(const End& end, bool entering) {
  const double bound = std::isfinite(end.t) ? std::max({end.hi - end.t, end.t - end.lo, 0.0}) * (1 + gamma(4)) : 0.0;
  return {end.t, bound, end.face, entering, false};
}

/// Reports the two ends of a chord.
///
/// A chord whose ends lie in the wrong order is none; but where their intervals meet the exact line may have one, and
/// another version of the same solid may see it. Then both ends are reported at one place between, so that a chord
/// which one version sees and another does not is always one whose ends count as one (solve_quadratic says why that
/// matters).
inline void emit_chord(const Chord& chord, Spans& out) {
  End enter = chord.enter, leave = chord.leave;
  if (!(enter.t <= leave.t)) {
    if (!(enter.lo <= leave.hi)) return;
    const double middle = enter.given ? enter.t : leave.given ? leave.t : 0.5 * enter.t + 0.5 * leave.t;
    if (!std::isfinite(middle)) return;
    enter.t = leave.t = middle;
  }
  // Each exact end lies on its side of the other, so no interval needs to reach past the other's: that of a face which
  // the ray skims would otherwise take in whatever stands behind the solid.
  enter.hi = std::min(enter.hi, leave.hi);
  leave.lo = std::max(leave.lo, enter.lo);
  const Crossing first = crossing_at(enter, true), second = crossing_at(leave, false);
  // A ray so far off that its squares overflow.
  if (std::isnan(first.bound) || std::isnan(second.bound)) return;
  out.push_back(first);
  out.push_back(second);
}

/// Where errors have brought the crossings of one solid out of order, from the one with index `begin` on, the later
/// ones are moved up to the earlier ones, by no more than their bounds.
inline void put_in_order(std::size_t begin, Spans& out) {
  for (std::size_t i = begin + 1; i < out.size(); ++i) {
    if (out[i].t >= out[i - 1].t) continue;
    out[i].bound += out[i - 1].t - out[i].t;
    out[i].t = out[i - 1].t;
  }
}

/// Reports two chords of one solid, the first before the second.
inline void emit_chords(const Chord& first, const Chord& second, Spans& out) {
  const std::size_t begin = out.size();
  emit_chord(first, out);
  emit_chord(second, out);
  put_in_order(begin, out);
}

/// The end of a root of a lateral surface, moved back by the expansion point; the move rounds once.
inline End lateral_end(const BoundedRoot& root, double expansion_point, std::uint32_t face) {
  End end{{root.t + expansion_point, root.lo + expansion_point, root.hi + expansion_point}, face};
  if (std::isfinite(end.t)) {
    const double rounding = gamma(2) * std::fabs(end.t);
    end.lo -= rounding;
    end.hi += rounding;
  }
  return end;
}

}  // namespace tenon
