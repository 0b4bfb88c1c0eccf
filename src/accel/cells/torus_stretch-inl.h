// What of a ray lies in a ring within one cell. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_TORUS_STRETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_TORUS_STRETCH_INL_H_
#undef TENON_ACCEL_CELLS_TORUS_STRETCH_INL_H_
#else
#define TENON_ACCEL_CELLS_TORUS_STRETCH_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/scene_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// f of TorusQuartic along rays: f(s) = w(s)² + z(s)² - r², negative in the ring.
template <class D>
struct TorusLanes {
  hn::Vec<D> w0, w1, w2, z0, z1, r_square;

  hn::Vec<D> ValueAndSlope(D d, hn::Vec<D> s, hn::Vec<D>& slope) const {
    const auto w = hn::MulAdd(hn::MulAdd(w2, s, w1), s, w0), z = hn::MulAdd(z1, s, z0);
    const auto two = hn::Set(d, 2.0);
    const auto w_slope = hn::MulAdd(two, hn::Mul(w2, s), w1);
    slope = hn::Mul(two, hn::MulAdd(w, w_slope, hn::Mul(z, z1)));
    return hn::MulAdd(w, w, hn::MulSub(z, z, r_square));
  }

  /// The coefficients of f over [low, low + width] in Bernstein's basis: their signs change at least as often as f has
  /// roots there, and differ from the number of roots by an even number (Descartes' rule in that basis).
  void Bernstein(D d, hn::Vec<D> low, hn::Vec<D> width, hn::Vec<D>* b) const {
    // In y, s = low + width y.
    const auto z = hn::Add(z0, hn::Mul(z1, low)), dz = hn::Mul(z1, width);
    const auto w = hn::Add(hn::Mul(hn::Add(hn::Mul(w2, low), w1), low), w0);
    const auto dw = hn::Mul(hn::Add(w1, hn::Mul(hn::Add(w2, w2), low)), width),
               ddw = hn::Mul(w2, hn::Mul(width, width));
    const auto a0 = hn::Sub(hn::Add(hn::Mul(w, w), hn::Mul(z, z)), r_square);
    const auto half_a1 = hn::Add(hn::Mul(w, dw), hn::Mul(z, dz));
    const auto a2 = hn::Add(hn::Add(hn::Mul(dw, dw), hn::Mul(hn::Add(w, w), ddw)), hn::Mul(dz, dz));
    const auto half_a3 = hn::Mul(dw, ddw);
    const auto a4 = hn::Mul(ddw, ddw);
    const auto half = hn::Set(d, 0.5);
    b[0] = a0;
    b[1] = hn::Add(a0, hn::Mul(half, half_a1));
    b[2] = hn::Add(hn::Add(a0, half_a1), hn::Mul(hn::Set(d, 1.0 / 6), a2));
    b[3] = hn::Add(hn::Add(a0, hn::Mul(hn::Set(d, 1.5), half_a1)), hn::Mul(half, hn::Add(a2, half_a3)));
    b[4] = hn::Add(hn::Add(a0, hn::Add(half_a1, half_a1)), hn::Add(a2, hn::Add(hn::Add(half_a3, half_a3), a4)));
  }
};

/// The only root between two places of opposite signs, by Newton's method kept inside the bracket by bisection.
/// @return where it has not come to rest
template <class D>
HWY_INLINE hn::Mask<D> PolishRoot(D d, const TorusLanes<D>& f, hn::Mask<D> lanes, hn::Vec<D> low, hn::Vec<D> high,
                                  hn::Vec<D> value_low, hn::Vec<D> value_high, hn::Vec<D> rest, hn::Vec<D>& root,
                                  hn::Vec<D>& slope) {
  const auto zero = hn::Zero(d);
  const auto rises = hn::Lt(value_low, zero);
  root = hn::Add(low, hn::Mul(hn::Sub(high, low), hn::Div(value_low, hn::Sub(value_low, value_high))));
  auto moving = lanes;
  for (int step = 0; step < 24 && !hn::AllFalse(d, moving); ++step) {
    const auto value = f.ValueAndSlope(d, root, slope);
    const auto below = hn::Lt(value, zero);
    // The root lies above where f is still of the sign it has at `low`.
    const auto is_low = hn::Not(hn::Xor(below, rises));
    low = hn::IfThenElse(is_low, root, low);
    high = hn::IfThenElse(is_low, high, root);
    auto next = hn::Sub(root, hn::Div(value, slope));
    const auto inside = hn::And(hn::Ge(next, low), hn::Le(next, high));
    next = hn::IfThenElse(inside, next, hn::Mul(hn::Set(d, 0.5), hn::Add(low, high)));
    const auto step_size = hn::Abs(hn::Sub(next, root));
    root = hn::IfThenElse(moving, next, root);
    moving = hn::And(moving, hn::Gt(step_size, rest));
  }
  return moving;
}

/// The ring in the stretch from t_in to t_out of each ray: up to two crossings there. What lies outside of the stretch
/// is not looked at.
template <class D, class Record>
HWY_NOINLINE Stretch<D> TorusStretch(D d, const SceneRays<D>& ray, const Record& r, hn::Vec<D> t_in, hn::Vec<D> t_out,
                                     hn::Mask<D> lanes) {
  Vec3Lanes<D> place;
  const auto shift = Approach(ray, Sub3(ray.origin, Load3(d, r, TorusRecord::center)), place);
  const auto o = Map3(d, r, TorusRecord::map, place), v = Map3(d, r, TorusRecord::map, ray.direction);
  const auto R = r[TorusRecord::major], minor = r[TorusRecord::minor], minor_square = hn::Mul(minor, minor);
  const auto inverse_R = hn::Div(hn::Set(d, 1.0), R), half_inverse_R = hn::Div(hn::Set(d, 0.5), R);
  TorusLanes<D> f;
  f.w0 = hn::Mul(hn::Sub(FusedDot(o, o), hn::Add(hn::Mul(R, R), minor_square)), half_inverse_R);
  f.w1 = hn::Mul(FusedDot(o, v), inverse_R);
  f.w2 = hn::Mul(FusedDot(v, v), half_inverse_R);
  f.z0 = o.z;
  f.z1 = v.z;
  f.r_square = minor_square;

  const auto zero = hn::Zero(d), infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  const auto error = r[TorusRecord::error];
  const auto least_slope = hn::Mul(r[TorusRecord::least], ray.length);
  const auto margin = hn::Mul(hn::Set(d, 4.0), ray.near);
  const auto begin = hn::Sub(hn::Sub(t_in, shift), margin), end = hn::Add(hn::Sub(t_out, shift), margin);
  auto low = begin, width = hn::Sub(end, begin);
  Stretch<D> s;
  s.enter = s.leave = infinity;
  s.unsure = hn::Lt(ray.near, zero);  // none
  s.hit = s.unsure;
  auto first = infinity, second = infinity;
  auto inside_at_begin = s.unsure;
  auto active = lanes;
  for (int round = 0; !hn::AllFalse(d, active); ++round) {
    hn::Vec<D> b[5];
    f.Bernstein(d, low, width, b);
    const auto least = hn::Min(hn::Min(hn::Min(b[0], b[1]), hn::Min(b[2], b[3])), b[4]);
    const auto greatest = hn::Max(hn::Max(hn::Max(b[0], b[1]), hn::Max(b[2], b[3])), b[4]);
    const auto outside = hn::Gt(least, error), inside = hn::Lt(greatest, hn::Neg(error));
    const auto constant = hn::And(active, hn::Or(outside, inside));
    if (round == 0) inside_at_begin = hn::Lt(b[0], zero);
    const auto certain_ends = hn::Gt(hn::Min(hn::Abs(b[0]), hn::Abs(b[4])), error);
    s.unsure = hn::Or(s.unsure, hn::AndNot(hn::Gt(hn::Abs(b[0]), error), active));
    // One change of sign, and so one root: b ascends or descends through zero once.
    const hn::Mask<D> negative[5] = {hn::Lt(b[0], zero), hn::Lt(b[1], zero), hn::Lt(b[2], zero), hn::Lt(b[3], zero),
                                     hn::Lt(b[4], zero)};
    auto changes = zero;
    for (int k = 0; k < 4; ++k) {
      changes = hn::Add(changes, hn::IfThenElseZero(hn::Xor(negative[k], negative[k + 1]), hn::Set(d, 1.0)));
    }
    const auto one = hn::And(hn::And(active, certain_ends), hn::Eq(changes, hn::Set(d, 1.0)));
    if (!hn::AllFalse(d, one)) {
      hn::Vec<D> root, slope;
      const auto rest = hn::Mul(hn::Set(d, 0x1p-6), ray.near);
      const auto restless = PolishRoot(d, f, one, low, hn::Add(low, width), b[0], b[4], rest, root, slope);
      const auto flat = hn::Le(hn::Abs(slope), least_slope);
      s.unsure = hn::Or(s.unsure, hn::And(one, hn::Or(restless, flat)));
      const auto t = hn::Add(root, shift);
      const auto is_first = hn::And(one, hn::Eq(first, infinity));
      const auto is_second = hn::AndNot(is_first, hn::And(one, hn::Eq(second, infinity)));
      s.unsure = hn::Or(s.unsure, hn::AndNot(hn::Or(is_first, is_second), one));  // a third
      first = hn::IfThenElse(is_first, t, first);
      second = hn::IfThenElse(is_second, t, second);
    }
    const auto settled = hn::Or(constant, one);
    low = hn::IfThenElse(settled, hn::Add(low, width), low);
    const auto rest_of_it = hn::Sub(end, low);
    width = hn::IfThenElse(settled, rest_of_it, hn::Mul(hn::Set(d, 0.5), width));
    // Two roots nearer than this are left to whoever knows their bounds.
    s.unsure = hn::Or(s.unsure, hn::And(hn::AndNot(settled, active), hn::Le(width, margin)));
    active = hn::AndNot(s.unsure, hn::And(active, hn::Gt(rest_of_it, margin)));
    if (round == 40) {
      s.unsure = hn::Or(s.unsure, active);
      break;
    }
  }
  s.unsure = hn::And(s.unsure, lanes);
  // Inside at first, the ring is left at the first crossing; a second one would be the way back in.
  s.unsure = hn::Or(s.unsure, hn::And(inside_at_begin, hn::Lt(second, infinity)));
  s.enter = hn::IfThenElse(inside_at_begin, hn::Neg(infinity), first);
  s.leave = hn::IfThenElse(inside_at_begin, first, second);
  s.hit = hn::Lt(s.enter, infinity);
  DoubtShort(d, ray, s);
  return s;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
