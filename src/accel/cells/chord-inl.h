// The chords of placed shapes, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_CHORD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_CHORD_INL_H_
#undef TENON_ACCEL_CELLS_CHORD_INL_H_
#else
#define TENON_ACCEL_CELLS_CHORD_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "accel/cells/find_crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// The part of a ray's line inside a convex solid: both its crossings.
struct Chord {
  CrossingLanes<One> enter, leave;
  bool hit, unsure;
};

/// @param shape    one that has chords
/// @param on_face  the face that the ray starts on, or -1
/// @param length   of the ray's direction
HWY_INLINE Chord FindChord(const RayLanes<One>& ray, const PlacedShapes& shapes, ShapeRef shape, int on_face,
                           double reach, double length) {
  const auto take = [&]<class Shape>(const HugePageVector<Shape>& list) {
    return SharedShape<One, Shape>(list[shape.index()]);
  };
  Chord chord;
  // Of two chords none is told.
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  const auto find = [&](bool enters) HWY_ATTR {
    return FindCrossing(One(), ray, shapes, shape.kind(), take, on_face, reach, length, enters, nowhere);
  };
  chord.enter = find(true);
  chord.leave = find(false);
  // Ends that lie so near to each other that either may come first.
  const double width = chord.leave.t - chord.enter.t;
  const bool hit = chord.enter.hit && chord.leave.hit;
  chord.unsure = chord.enter.unsure || chord.leave.unsure || (hit && !(std::fabs(width) > 4 * ray.resolution));
  chord.hit = hit && width > 0;
  return chord;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
