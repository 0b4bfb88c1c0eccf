// Rays nearly parallel to faces, and lines that graze quadrics. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_FLAT_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_FLAT_RAYS_INL_H_
#undef TENON_ACCEL_CELLS_FLAT_RAYS_INL_H_
#else
#define TENON_ACCEL_CELLS_FLAT_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "accel/cells/scene_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// A ray nearly parallel to a face is not sure of it unless the face is too far off to be met in the scene: 16 reach
/// times the least slope.
template <class D>
HWY_INLINE hn::Mask<D> DoubtFlat(D d, hn::Vec<D> slope, hn::Vec<D> length, hn::Vec<D> least, double reach,
                                 hn::Vec<D> distance) {
  const auto flat = hn::Le(hn::Abs(slope), hn::Mul(least, length));
  return hn::And(flat, hn::Le(hn::Abs(distance), hn::Mul(hn::Set(d, 16 * reach), least)));
}

/// Along one axis of the world.
template <class D>
HWY_INLINE void ClipAligned(D, hn::Vec<D> origin, hn::Vec<D> slowness, hn::Vec<D> low, hn::Vec<D> high, Stretch<D>& s) {
  const auto a = hn::Mul(hn::Sub(low, origin), slowness);
  const auto b = hn::Mul(hn::Sub(high, origin), slowness);
  s.enter = hn::Max(s.enter, hn::Min(a, b));
  s.leave = hn::Min(s.leave, hn::Max(a, b));
}

template <class D>
HWY_INLINE Stretch<D> WholeStretch(D d) {
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  const auto all = hn::Eq(infinity, infinity);
  return {hn::Neg(infinity), infinity, all, hn::Not(all)};
}

/// 1 / x, large instead of infinite.
template <class D>
HWY_INLINE hn::Vec<D> Slowness(D d, hn::Vec<D> x) {
  const auto most = hn::Set(d, 0x1p100);
  return hn::Max(hn::Min(hn::Div(hn::Set(d, 1.0), x), most), hn::Neg(most));
}

/// The part of a ray between two planes across z of a frame.
/// @param z, slope  where it begins there, and how far it goes along z
/// @param least     over the length of the ray: slopes up to there are not certain
template <class D>
HWY_INLINE Stretch<D> BetweenCaps(D d, hn::Vec<D> z, hn::Vec<D> slope, hn::Vec<D> length, hn::Vec<D> low,
                                  hn::Vec<D> high, hn::Vec<D> least, double reach) {
  Stretch<D> slab = WholeStretch(d);
  ClipAligned(d, z, Slowness(d, slope), low, high, slab);
  const auto to_cap = hn::Min(hn::Abs(hn::Sub(z, low)), hn::Abs(hn::Sub(high, z)));
  slab.unsure = DoubtFlat(d, slope, length, least, reach, to_cap);
  return slab;
}

/// Lines that graze a quadric, or pass the tip of a cone, but not between two places.
///
/// F(t) = a t² + 2 b t + c has the discriminant D, so a F = (a t + b)² - D. With |D| up to `graze` and (a t + b)² above
/// four times that, a F is above three times it. So |F| is more than six times the bound on its error that Certainty's
/// graze is made from, and its sign that of a, for a is at most (1 + gamma) |direction|² in the quadric's frame, and
/// graze as much larger.
/// @return where that holds from t_in to t_out
template <class D>
HWY_NOINLINE hn::Mask<D> GrazesElsewhere(D d, hn::Vec<D> a, hn::Vec<D> b, hn::Vec<D> graze, hn::Vec<D> t_in,
                                         hn::Vec<D> t_out) {
  const auto first = hn::MulAdd(a, t_in, b), last = hn::MulAdd(a, t_out, b);
  const auto least = hn::Mul(hn::Set(d, 2.0), hn::Sqrt(graze));
  return hn::Or(hn::Gt(hn::Min(first, last), least), hn::Lt(hn::Max(first, last), hn::Neg(least)));
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
