// Crossings of tori from their neighbourhood, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_TORUS_ROOT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_TORUS_ROOT_INL_H_
#undef TENON_ACCEL_CELLS_TORUS_ROOT_INL_H_
#else
#define TENON_ACCEL_CELLS_TORUS_ROOT_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/crossing-inl.h"
#include "primitive/torus_quartic.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// The crossing that spans() reports near a place on each ray, for rays that do not start on the torus:
/// SettledTorusRoot, by the same operations in the same order.
/// @param near      the place, known within 4 resolutions
/// @param entering  whether it is one where the ray enters
/// @return unsure where spans() may report another double
template <class D, class Lanes>
HWY_INLINE CrossingLanes<D> TorusCrossing(D d, const RayLanes<D>& ray, const Lanes& shape, hn::Vec<D> near,
                                          hn::Mask<D> entering) {
  using Shape = typename Lanes::Shape;
  using Root = SettledTorusRoot;
  const LocalLanes<D> local =
      ToLocal(d, ray, shape, Get3(d, shape, &Shape::center), Get3(d, shape, &Shape::origin), false);
  const auto R = shape.Get(&Shape::major), r = shape.Get(&Shape::minor);
  const auto one = hn::Set(d, 1.0), two = hn::Set(d, 2.0);
  const auto square = Dot(local.direction, local.direction), speed = hn::Sqrt(square);
  const auto step = hn::Mul(hn::PowerOfTwoBelow(d, hn::Div(r, speed)), hn::Set(d, Root::relative_step));
  const auto steps = hn::Mul(hn::Sub(near, local.shift), hn::Div(one, step));
  const auto nearest = hn::Round(steps);
  // As many steps away from the middle between two multiples as the place may be off.
  const auto off = hn::Div(hn::Mul(hn::Set(d, 4.0), ray.resolution), step);
  const auto clear = hn::Lt(hn::Add(hn::Abs(hn::Sub(steps, nearest)), off), hn::Set(d, 0.5));

  const auto from = hn::Mul(nearest, step);
  const auto p = MulAdd(from, local.direction, local.origin);
  const auto twice_R = hn::Mul(two, R), r_square = hn::Mul(r, r);
  const auto w0 = hn::Div(hn::Sub(Dot(p, p), hn::Add(hn::Mul(R, R), r_square)), twice_R);
  const auto w1 = hn::Div(Dot(p, local.direction), R), w2 = hn::Div(square, twice_R);
  const auto z1 = local.direction.z;
  auto s = hn::Zero(d), last = s, slope = s;
  for (int i = 0; i < Root::newton_steps; ++i) {
    const auto w = hn::Add(hn::Mul(hn::Add(hn::Mul(w2, s), w1), s), w0), z = hn::Add(p.z, hn::Mul(z1, s));
    const auto w_slope = hn::Add(w1, hn::Mul(hn::Mul(two, w2), s));
    slope = hn::Mul(two, hn::Add(hn::Mul(w, w_slope), hn::Mul(z, z1)));
    last = hn::Div(hn::Sub(hn::Add(hn::Mul(w, w), hn::Mul(z, z)), r_square), slope);
    s = hn::Sub(s, last);
  }
  const auto is_at_rest =
      hn::And(hn::Le(hn::Abs(last), hn::Mul(step, hn::Set(d, Root::relative_rest))), hn::Le(hn::Abs(s), step));
  const auto is_steep = hn::Ge(hn::Abs(slope), hn::Mul(hn::Set(d, 2 * Root::relative_slope), hn::Mul(r, speed)));
  const auto rising = hn::Gt(slope, hn::Zero(d));
  CrossingLanes<D> end;
  end.t = hn::Add(hn::Add(from, s), local.shift);
  end.face = hn::Zero(d);
  end.hit = hn::And(hn::And(clear, hn::Xor(entering, rising)), hn::And(is_at_rest, is_steep));
  end.unsure = hn::Not(end.hit);
  return end;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
