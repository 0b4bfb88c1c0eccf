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
template <class D>
struct ChordLanes {
  CrossingLanes<D> enter, leave;
  hn::Mask<D> hit, unsure;
};

/// @param shape    one that has chords, for all rays
/// @param on_face  the face that the ray starts on, or -1; one lane then
/// @param length   of the rays' directions
template <class D>
HWY_INLINE ChordLanes<D> FindChord(D d, const RayLanes<D>& ray, const PlacedShapes& shapes, ShapeRef shape, int on_face,
                                   double reach, hn::Vec<D> length) {
  const auto take = [&]<class Shape>(const HugePageVector<Shape>& list) {
    return SharedShape<D, Shape>(list[shape.index()]);
  };
  const auto all = hn::Eq(length, length);
  ChordLanes<D> chord;
  // Of two chords none is told.
  const auto nowhere = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  const auto find = [&](hn::Mask<D> enters) HWY_ATTR {
    return FindCrossing(d, ray, shapes, shape.kind(), take, on_face, reach, length, enters, nowhere);
  };
  chord.enter = find(all);
  chord.leave = find(hn::Not(all));
  // Ends that lie so near to each other that either may come first.
  const auto width = hn::Sub(chord.leave.t, chord.enter.t);
  const auto least = hn::Mul(hn::Set(d, 4.0), ray.resolution);
  const auto hit = hn::And(chord.enter.hit, chord.leave.hit);
  const auto unsure = hn::Or(chord.enter.unsure, chord.leave.unsure);
  chord.unsure = hn::Or(unsure, hn::And(hit, hn::Not(hn::Gt(hn::Abs(width), least))));
  chord.hit = hn::And(hit, hn::Gt(width, hn::Zero(d)));
  return chord;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
