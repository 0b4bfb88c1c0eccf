// Where rays cross quadrics of revolution, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_REVOLVED_CROSSING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_REVOLVED_CROSSING_INL_H_
#undef TENON_ACCEL_CELLS_REVOLVED_CROSSING_INL_H_
#else
#define TENON_ACCEL_CELLS_REVOLVED_CROSSING_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Of a line that is steeper than the side, and lies within it but between two places, the crossing about where it is
/// looked for, if it is known there: one with a cap, or one with the side.
/// @param cap   the line cut with the caps
/// @param side  where it crosses the side
/// @param near  how far off the crossing may be
template <class D>
HWY_INLINE CrossingLanes<D> SteepCrossing(D d, const CrossingLanes<D>& cap, hn::Vec<D> side, hn::Vec<D> about,
                                          hn::Vec<D> near) {
  const auto at_cap = hn::Le(hn::Abs(hn::Sub(cap.t, about)), near);
  const auto at_side = hn::Le(hn::Abs(hn::Sub(side, about)), near);
  CrossingLanes<D> end;
  end.t = hn::IfThenElse(at_cap, cap.t, side);
  end.face = hn::IfThenElse(at_cap, cap.face, hn::Zero(d));
  end.hit = hn::Xor(at_cap, at_side);
  end.unsure = hn::Not(end.hit);
  return end;
}

/// @param about  where the crossing is looked for; where that is not known, anything but a number. Then a line that is
///               steeper than the side, and crosses it, is not told: it has two parts within.
template <class D, class Lanes>
HWY_INLINE CrossingLanes<D> RevolvedCrossing(D d, const RayLanes<D>& ray, const Lanes& shape, int on_face, double reach,
                                             hn::Vec<D> length, hn::Mask<D> enters, hn::Vec<D> about) {
  using Shape = typename Lanes::Shape;
  enum Face { side, bottom, top };
  const LocalLanes<D> local =
      ToLocal(d, ray, shape, Get3(d, shape, &Shape::center), Get3(d, shape, &Shape::origin), on_face >= 0);
  const Vec3Lanes<D>&o = local.origin, &v = local.direction;
  const auto cut = [&](hn::Mask<D> which) HWY_ATTR {
    return CutByCaps(d, local, shape.Get(&Shape::low), shape.Get(&Shape::high), bottom, top,
                     shape.Get(&Shape::least_slope), length, reach, on_face, which);
  };
  const CrossingLanes<D> cap = cut(enters);
  const auto zero = hn::Zero(d);

  // Step 1: q is expanded where the line is nearest to the axis between the caps (RevolvedQuadric::find_window), or at
  // the start.
  auto at = zero;
  Vec3Lanes<D> p = o;
  if (on_face != side) {
    const auto other = cut(hn::Not(enters)).t;
    const auto first = hn::IfThenElse(enters, cap.t, other), last = hn::IfThenElse(enters, other, cap.t);
    const auto square = hn::Add(hn::Mul(v.x, v.x), hn::Mul(v.y, v.y));
    const auto nearest = hn::Div(hn::Neg(hn::Add(hn::Mul(o.x, v.x), hn::Mul(o.y, v.y))), square);
    const auto not_before = hn::IfThenElse(hn::Gt(nearest, first), nearest, first);
    at = hn::IfThenElse(hn::Gt(not_before, last), last, not_before);
    p = MulAdd(at, v, o);
  }

  // Step 2: q = a s² + 2 b s + c (RevolvedQuadric::expand).
  const auto slope = shape.Get(&Shape::slope), linear = shape.Get(&Shape::linear);
  const auto w = hn::Add(shape.Get(&Shape::offset), hn::Mul(slope, p.z)), w_slope = hn::Mul(slope, v.z);
  const auto a = hn::Sub(hn::Add(hn::Mul(v.x, v.x), hn::Mul(v.y, v.y)), hn::Mul(w_slope, w_slope));
  const auto b_across = hn::Add(hn::Mul(p.x, v.x), hn::Mul(p.y, v.y));
  const auto half_linear = hn::Mul(hn::Set(d, 0.5), linear);
  const auto b = hn::Sub(hn::Sub(b_across, hn::Mul(w, w_slope)), hn::Mul(half_linear, v.z));

  // Step 3: its roots (solve_quadratic, solve_deflated), the one where the line enters the side or leaves it.
  const auto steep = hn::Lt(a, zero);
  const auto takes_first = hn::Xor(enters, steep);
  auto unsure = hn::Eq(a, zero), real = hn::Not(unsure);
  auto t = zero;
  if (on_face == side) {
    const auto other = hn::Div(hn::Mul(hn::Set(d, -2.0), b), a);
    t = hn::IfThenElse(hn::Xor(takes_first, hn::Ge(other, zero)), other, zero);
    unsure = hn::Or(unsure, hn::Not(hn::Gt(hn::Abs(a), hn::Mul(shape.Get(&Shape::start), ray.square))));
  } else {
    const auto c_across = hn::Add(hn::Mul(p.x, p.x), hn::Mul(p.y, p.y));
    const auto c =
        hn::Sub(hn::Sub(hn::Sub(c_across, hn::Mul(w, w)), hn::Mul(linear, p.z)), shape.Get(&Shape::constant));
    const RootsLanes<D> roots = FindRoots(d, a, b, c, hn::Mul(shape.Get(&Shape::graze), ray.square));
    real = roots.real;
    unsure = roots.unsure;
    t = hn::Add(hn::IfThenElse(takes_first, roots.first, roots.second), at);
  }
  // What is not settled is moved once more. A start is not.
  const auto place = MulAdd(t, v, o);
  const auto settled =
      hn::Gt(hn::Add(hn::Mul(place.x, place.x), hn::Mul(place.y, place.y)), shape.Get(&Shape::settled));
  const auto is_start = on_face == side ? hn::Eq(t, zero) : hn::Not(hn::Eq(zero, zero));
  const auto unsettled = hn::Not(hn::Or(settled, is_start));

  // Step 4: the part within the side, or one of the two.
  const auto side_unsure = hn::Or(unsure, hn::And(real, unsettled));
  CrossingLanes<D> end = cap;
  Cut(d, hn::Eq(a, a), enters, t, zero, end);
  end.hit = hn::And(end.hit, real);
  end.unsure = hn::Or(end.unsure, side_unsure);
  end.t = hn::Add(end.t, local.shift);
  if (HWY_UNLIKELY(!hn::AllFalse(d, steep))) {
    // A line that does not cross the side runs within it from cap to cap.
    const auto meets = hn::And(steep, real), whole = hn::AndNot(real, steep);
    CrossingLanes<D> of_cap = cap;
    of_cap.t = hn::Add(cap.t, local.shift);
    const CrossingLanes<D> one =
        SteepCrossing(d, of_cap, hn::Add(t, local.shift), about, hn::Mul(hn::Set(d, 4.0), ray.resolution));
    const auto keep = hn::Not(steep);
    end.t = hn::IfThenElse(steep, hn::IfThenElse(whole, of_cap.t, one.t), end.t);
    end.face = hn::IfThenElse(steep, hn::IfThenElse(whole, of_cap.face, one.face), end.face);
    end.hit = hn::Or(hn::And(keep, end.hit), hn::Or(hn::And(whole, cap.hit), hn::And(meets, one.hit)));
    end.unsure = hn::Or(end.unsure, hn::And(meets, one.unsure));
  }
  return end;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
