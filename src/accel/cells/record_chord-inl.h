// The chords of leaf records, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_RECORD_CHORD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_RECORD_CHORD_INL_H_
#undef TENON_ACCEL_CELLS_RECORD_CHORD_INL_H_
#else
#define TENON_ACCEL_CELLS_RECORD_CHORD_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/scene_rays-inl.h"
#include "accel/cells/torus_stretch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE Stretch<D> BallStretch(D d, const SceneRays<D>& ray, const double* r) {
  const auto from = Sub3(ray.origin, Load3(d, r + BallRecord::center));
  const auto nearest = hn::Neg(hn::Mul(Dot(from, ray.direction), ray.inverse_square));
  const auto p = MulAdd(nearest, ray.direction, from);
  const auto square = hn::Sub(hn::Set(d, r[BallRecord::square]), Dot(p, p));
  const auto graze = hn::Set(d, r[BallRecord::graze]);
  const auto half = hn::Sqrt(hn::Mul(hn::Max(square, graze), ray.inverse_square));
  return {hn::Sub(nearest, half), hn::Add(nearest, half), hn::Gt(square, graze), hn::Le(hn::Abs(square), graze)};
}

/// A ray nearly parallel to a face is not sure of it unless the face is too far off to be met in the scene: 16 reach
/// times the least slope.
template <class D>
HWY_INLINE hn::Mask<D> DoubtFlat(D d, hn::Vec<D> slope, hn::Vec<D> length, double least, double reach,
                                 hn::Vec<D> distance) {
  const auto flat = hn::Le(hn::Abs(slope), hn::Mul(hn::Set(d, least), length));
  return hn::And(flat, hn::Le(hn::Abs(distance), hn::Set(d, 16 * reach * least)));
}

/// Along one axis of the world.
template <class D>
HWY_INLINE void ClipAligned(D d, hn::Vec<D> origin, hn::Vec<D> slowness, double low, double high, Stretch<D>& s) {
  const auto a = hn::Mul(hn::Sub(hn::Set(d, low), origin), slowness);
  const auto b = hn::Mul(hn::Sub(hn::Set(d, high), origin), slowness);
  s.enter = hn::Max(s.enter, hn::Min(a, b));
  s.leave = hn::Min(s.leave, hn::Max(a, b));
}

template <class D>
HWY_INLINE Stretch<D> WholeStretch(D d) {
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  const auto all = hn::Eq(infinity, infinity);
  return {hn::Neg(infinity), infinity, all, hn::Not(all)};
}

template <class D>
HWY_INLINE Stretch<D> AlignedBoxStretch(D d, const SceneRays<D>& ray, const double* r, double least, double reach) {
  Stretch<D> s = WholeStretch(d);
  const double *low = r + AlignedBoxRecord::low, *high = r + AlignedBoxRecord::high;
  ClipAligned(d, ray.origin.x, ray.slowness.x, low[0], high[0], s);
  ClipAligned(d, ray.origin.y, ray.slowness.y, low[1], high[1], s);
  ClipAligned(d, ray.origin.z, ray.slowness.z, low[2], high[2], s);
  if (HWY_UNLIKELY(ray.flat)) {
    const hn::Vec<D> origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z};
    const hn::Vec<D> direction[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double end : {low[axis], high[axis]}) {
        const auto distance = hn::Sub(hn::Set(d, end), origin[axis]);
        s.unsure = hn::Or(s.unsure, DoubtFlat(d, direction[axis], ray.length, least, reach, distance));
      }
    }
  }
  DoubtShort(d, ray, s);
  return s;
}

/// 1 / x, large instead of infinite.
template <class D>
HWY_INLINE hn::Vec<D> Slowness(D d, hn::Vec<D> x) {
  const auto most = hn::Set(d, 0x1p100);
  return hn::Max(hn::Min(hn::Div(hn::Set(d, 1.0), x), most), hn::Neg(most));
}

template <class D>
HWY_INLINE Stretch<D> BoxStretch(D d, const SceneRays<D>& ray, const double* r, double reach) {
  const auto o = Map3(d, r + BoxRecord::map, Sub3(ray.origin, Load3(d, r + BoxRecord::center)));
  const auto v = Map3(d, r + BoxRecord::map, ray.direction);
  Stretch<D> s = WholeStretch(d);
  const hn::Vec<D> origin[3] = {o.x, o.y, o.z}, direction[3] = {v.x, v.y, v.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ClipAligned(d, origin[axis], Slowness(d, direction[axis]), -1, 1, s);
    const double least = r[BoxRecord::least + axis];
    const auto distance = hn::Abs(hn::Sub(hn::Abs(origin[axis]), hn::Set(d, 1.0)));
    s.unsure = hn::Or(s.unsure, DoubtFlat(d, direction[axis], ray.length, least, reach, distance));
  }
  DoubtShort(d, ray, s);
  return s;
}

/// What of the line o + t v lies within the side of a solid of revolution, cut from the part between the caps, `s`.
template <class D>
HWY_INLINE void ClipSide(D d, const SceneRays<D>& ray, const Vec3Lanes<D>& o, const Vec3Lanes<D>& v, const double* p,
                         Stretch<D>& s) {
  const auto zero = hn::Zero(d);
  const auto beta = hn::Set(d, p[ProfileRecord::beta]), gamma = hn::Set(d, p[ProfileRecord::gamma]);
  const auto across = hn::Add(hn::Mul(v.x, v.x), hn::Mul(v.y, v.y));
  const auto across_square = hn::Add(hn::Mul(o.x, o.x), hn::Mul(o.y, o.y));
  const auto gz = hn::Mul(gamma, o.z);
  const auto a = hn::Sub(across, hn::Mul(hn::Mul(gamma, v.z), v.z));
  const auto b =
      hn::Sub(hn::Add(hn::Mul(o.x, v.x), hn::Mul(o.y, v.y)), hn::Mul(hn::Add(hn::Mul(hn::Set(d, 0.5), beta), gz), v.z));
  const auto c = hn::Sub(across_square, hn::Add(hn::Set(d, p[ProfileRecord::alpha]), hn::Mul(hn::Add(beta, gz), o.z)));
  const auto discriminant = hn::Sub(hn::Mul(b, b), hn::Mul(a, c));
  const auto square = hn::Mul(ray.length, ray.length);
  const auto graze = hn::Mul(hn::Set(d, p[ProfileRecord::graze]), square);
  auto unsure = hn::Le(hn::Abs(discriminant), graze);
  const auto real = hn::Gt(discriminant, graze);
  const auto root = hn::Sqrt(hn::Max(discriminant, graze));
  const auto sum = hn::IfThenElse(hn::Ge(b, zero), hn::Neg(hn::Add(b, root)), hn::Sub(root, b));
  const auto near = hn::Div(c, sum), far = hn::Div(sum, a);
  const auto first = hn::Min(near, far), second = hn::Max(near, far);
  auto enter = hn::Max(s.enter, first), leave = hn::Min(s.leave, second);
  auto hit = real;
  if (p[ProfileRecord::gamma] > 0) {
    // Steeper than the side: outside between the roots, or inside all along.
    const auto steep = hn::Lt(a, zero);
    if (!hn::AllFalse(d, steep)) {
      const auto before = hn::Min(s.leave, first), after = hn::Max(s.enter, second);
      const auto least = ShortestStretch(d, ray);
      const auto width_before = hn::Sub(before, s.enter), width_after = hn::Sub(s.leave, after);
      const auto meets_before = hn::Gt(width_before, zero), meets_after = hn::Gt(width_after, zero);
      const auto parts = hn::And(steep, real);
      const auto doubtful = hn::Or(hn::And(meets_before, meets_after),
                                   hn::Or(hn::Le(hn::Abs(width_before), least), hn::Le(hn::Abs(width_after), least)));
      unsure = hn::Or(unsure, hn::And(parts, doubtful));
      hit = Choose(steep, hn::Or(hn::Not(real), hn::Or(meets_before, meets_after)), hit);
      const auto whole = hn::AndNot(real, steep);
      const auto later = hn::AndNot(meets_before, parts), sooner = hn::And(meets_before, parts);
      enter = hn::IfThenElse(hn::Or(whole, sooner), s.enter, hn::IfThenElse(later, after, enter));
      leave = hn::IfThenElse(hn::Or(whole, later), s.leave, hn::IfThenElse(sooner, before, leave));
    }
  } else if (p[ProfileRecord::parallel] > 0) {
    // Along the axis, as far as the caps: the whole line is on one side.
    const auto parallel = hn::Le(across, hn::Mul(hn::Set(d, p[ProfileRecord::parallel]), square));
    if (!hn::AllFalse(d, parallel)) {
      const auto inside = hn::Lt(across_square, hn::Set(d, p[ProfileRecord::inside]));
      const auto outside = hn::Gt(across_square, hn::Set(d, p[ProfileRecord::outside]));
      enter = hn::IfThenElse(parallel, s.enter, enter);
      leave = hn::IfThenElse(parallel, s.leave, leave);
      hit = Choose(parallel, inside, hit);
      unsure = Choose(parallel, hn::Not(hn::Or(inside, outside)), unsure);
    }
  }
  s.enter = enter;
  s.leave = leave;
  s.hit = hn::And(s.hit, hit);
  s.unsure = hn::Or(s.unsure, unsure);
}

template <class D>
HWY_INLINE void FinishStretch(D d, const SceneRays<D>& ray, hn::Vec<D> shift, Stretch<D>& s) {
  s.enter = hn::Add(s.enter, shift);
  s.leave = hn::Add(s.leave, shift);
  DoubtShort(d, ray, s);
}

template <class D>
HWY_INLINE Stretch<D> UprightStretch(D d, const SceneRays<D>& ray, const double* r, double least, double reach) {
  Vec3Lanes<D> o;
  const auto shift = Approach(ray, Sub3(ray.origin, Load3(d, r + UprightRecord::center)), o);
  const double* p = r + UprightRecord::profile;
  Stretch<D> s = WholeStretch(d);
  ClipAligned(d, o.z, ray.slowness.z, p[ProfileRecord::low], p[ProfileRecord::high], s);
  if (HWY_UNLIKELY(ray.flat)) {
    const auto distance = hn::Sub(hn::Abs(o.z), hn::Set(d, p[ProfileRecord::high]));
    s.unsure = DoubtFlat(d, ray.direction.z, ray.length, least, reach, distance);
  }
  ClipSide(d, ray, o, ray.direction, p, s);
  FinishStretch(d, ray, shift, s);
  return s;
}

template <class D>
HWY_INLINE Stretch<D> FrustumStretch(D d, const SceneRays<D>& ray, const double* r, double reach) {
  Vec3Lanes<D> place;
  const auto shift = Approach(ray, Sub3(ray.origin, Load3(d, r + FrustumRecord::center)), place);
  const auto o = Map3(d, r + FrustumRecord::map, place), v = Map3(d, r + FrustumRecord::map, ray.direction);
  const double* p = r + FrustumRecord::profile;
  Stretch<D> s = WholeStretch(d);
  ClipAligned(d, o.z, Slowness(d, v.z), p[ProfileRecord::low], p[ProfileRecord::high], s);
  const auto distance = hn::Sub(hn::Abs(o.z), hn::Set(d, p[ProfileRecord::high]));
  s.unsure = DoubtFlat(d, v.z, ray.length, r[FrustumRecord::least], reach, distance);
  ClipSide(d, ray, o, v, p, s);
  FinishStretch(d, ray, shift, s);
  return s;
}

template <class D>
HWY_INLINE Stretch<D> ConvexStretch(D d, const SceneRays<D>& ray, const double* r, double reach) {
  Stretch<D> s = WholeStretch(d);
  const auto zero = hn::Zero(d);
  const double* plane = r + ConvexRecord::planes;
  for (auto left = static_cast<std::size_t>(r[ConvexRecord::count]); left > 0; --left) {
    const auto n = Load3(d, plane);
    const auto slope = Dot(n, ray.direction);
    const auto distance = hn::Sub(hn::Set(d, plane[3]), Dot(n, ray.origin));
    const auto slowness = Slowness(d, slope);
    const auto t = hn::Mul(distance, slowness);
    const auto leaves = hn::Gt(slowness, zero);  // a slope of -0 has the sign of its inverse
    s.enter = hn::IfThenElse(leaves, s.enter, hn::Max(s.enter, t));
    s.leave = hn::IfThenElse(leaves, hn::Min(s.leave, t), s.leave);
    s.unsure = hn::Or(s.unsure, DoubtFlat(d, slope, ray.length, r[ConvexRecord::least], reach, distance));
    plane += ConvexRecord::plane_size;
  }
  DoubtShort(d, ray, s);
  return s;
}

/// The stretch of any record.
/// @param t_in, t_out  the part of each ray that matters: crossings elsewhere may be left out
/// @param lanes        the rays that matter
template <class D>
HWY_INLINE Stretch<D> FindStretch(D d, const SceneRays<D>& ray, const LeafRecords& records, RecordRef ref, double reach,
                                  hn::Vec<D> t_in, hn::Vec<D> t_out, hn::Mask<D> lanes) {
  const double* r = records.values(ref);
  switch (ref.kind()) {
    case RecordKind::ball:
      return BallStretch(d, ray, r);
    case RecordKind::aligned_box:
      return AlignedBoxStretch(d, ray, r, records.least_slope, reach);
    case RecordKind::box:
      return BoxStretch(d, ray, r, reach);
    case RecordKind::upright:
      return UprightStretch(d, ray, r, records.least_slope, reach);
    case RecordKind::frustum:
      return FrustumStretch(d, ray, r, reach);
    case RecordKind::convex:
      return ConvexStretch(d, ray, r, reach);
    case RecordKind::torus:
      return TorusStretch(d, ray, r, t_in, t_out, lanes);
    case RecordKind::general:
      break;
  }
  Stretch<D> none = WholeStretch(d);
  none.unsure = none.hit;
  return none;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
