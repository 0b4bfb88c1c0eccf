// The chords of leaf records, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_RECORD_CHORD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_RECORD_CHORD_INL_H_
#undef TENON_ACCEL_CELLS_RECORD_CHORD_INL_H_
#else
#define TENON_ACCEL_CELLS_RECORD_CHORD_INL_H_
#endif

#include <hwy/highway.h>

#include <type_traits>

#include "accel/cells/flat_rays-inl.h"
#include "accel/cells/outline_stretch-inl.h"
#include "accel/cells/revolved_stretch-inl.h"
#include "accel/cells/scene_rays-inl.h"
#include "accel/cells/torus_stretch-inl.h"
#include "accel/cells/twisted_stretch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

template <class D, class Record>
HWY_INLINE Stretch<D> BallStretch(D d, const SceneRays<D>& ray, const Record& r) {
  const auto from = Sub3(ray.origin, Load3(d, r, BallRecord::center));
  const auto nearest = hn::Neg(hn::Mul(FusedDot(from, ray.direction), ray.inverse_square));
  const auto p = FusedMulAdd(nearest, ray.direction, from);
  const auto square = hn::Sub(r[BallRecord::square], FusedDot(p, p));
  const auto graze = r[BallRecord::graze];
  const auto half = hn::Sqrt(hn::Mul(hn::Max(square, graze), ray.inverse_square));
  return {hn::Sub(nearest, half), hn::Add(nearest, half), hn::Gt(square, graze), hn::Le(hn::Abs(square), graze)};
}

template <class D, class Record>
HWY_INLINE Stretch<D> AlignedBoxStretch(D d, const SceneRays<D>& ray, const Record& r, double least, double reach) {
  Stretch<D> s = WholeStretch(d);
  const Vec3Lanes<D> low = Load3(d, r, AlignedBoxRecord::low), high = Load3(d, r, AlignedBoxRecord::high);
  ClipAligned(d, ray.origin.x, ray.slowness.x, low.x, high.x, s);
  ClipAligned(d, ray.origin.y, ray.slowness.y, low.y, high.y, s);
  ClipAligned(d, ray.origin.z, ray.slowness.z, low.z, high.z, s);
  if (HWY_UNLIKELY(ray.flat)) {
    const auto doubt = [&](hn::Vec<D> origin, hn::Vec<D> slope, hn::Vec<D> end) {
      const auto distance = hn::Sub(end, origin);
      s.unsure = hn::Or(s.unsure, DoubtFlat(d, slope, ray.length, hn::Set(d, least), reach, distance));
    };
    for (const Vec3Lanes<D>& ends : {low, high}) {
      doubt(ray.origin.x, ray.direction.x, ends.x);
      doubt(ray.origin.y, ray.direction.y, ends.y);
      doubt(ray.origin.z, ray.direction.z, ends.z);
    }
  }
  DoubtShort(d, ray, s);
  return s;
}

template <class D, class Record>
HWY_INLINE Stretch<D> BoxStretch(D d, const SceneRays<D>& ray, const Record& r, double reach) {
  const auto o = Map3(d, r, BoxRecord::map, Sub3(ray.origin, Load3(d, r, BoxRecord::center)));
  const auto v = Map3(d, r, BoxRecord::map, ray.direction);
  Stretch<D> s = WholeStretch(d);
  const auto one = hn::Set(d, 1.0), minus_one = hn::Set(d, -1.0);
  const hn::Vec<D> origin[3] = {o.x, o.y, o.z}, direction[3] = {v.x, v.y, v.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ClipAligned(d, origin[axis], Slowness(d, direction[axis]), minus_one, one, s);
    const auto distance = hn::Abs(hn::Sub(hn::Abs(origin[axis]), one));
    s.unsure = hn::Or(s.unsure, DoubtFlat(d, direction[axis], ray.length, r[BoxRecord::least + axis], reach, distance));
  }
  DoubtShort(d, ray, s);
  return s;
}

/// What of the line o + t v lies within the side of a solid of revolution, cut from the part between the caps, `s`.
/// @param p            where its ProfileRecord stands in the record
/// @param t_in, t_out  what of the line matters
template <class D, class Record>
HWY_INLINE void ClipSide(D d, const SceneRays<D>& ray, const Vec3Lanes<D>& o, const Vec3Lanes<D>& v, const Record& r,
                         std::size_t p, hn::Vec<D> t_in, hn::Vec<D> t_out, Stretch<D>& s) {
  const auto zero = hn::Zero(d);
  const auto beta = r[p + ProfileRecord::beta], gamma = r[p + ProfileRecord::gamma];
  const auto across = hn::MulAdd(v.x, v.x, hn::Mul(v.y, v.y));
  const auto across_square = hn::MulAdd(o.x, o.x, hn::Mul(o.y, o.y));
  const auto gz = hn::Mul(gamma, o.z);
  const auto a = hn::NegMulAdd(hn::Mul(gamma, v.z), v.z, across);
  const auto b = hn::NegMulAdd(hn::MulAdd(hn::Set(d, 0.5), beta, gz), v.z, hn::MulAdd(o.x, v.x, hn::Mul(o.y, v.y)));
  const auto c = hn::Sub(across_square, hn::MulAdd(hn::Add(beta, gz), o.z, r[p + ProfileRecord::alpha]));
  const auto discriminant = hn::MulSub(b, b, hn::Mul(a, c));
  const auto square = hn::Mul(ray.length, ray.length);
  const auto graze = hn::Mul(r[p + ProfileRecord::graze], square);
  auto unsure = hn::Le(hn::Abs(discriminant), graze);
  if (HWY_UNLIKELY(!hn::AllFalse(d, unsure))) {
    // What is that near to another boundary may be one with it.
    const auto before = hn::Sub(t_in, ShortestStretch(d, ray)), behind = hn::Add(t_out, ShortestStretch(d, ray));
    unsure = hn::AndNot(GrazesElsewhere(d, a, b, graze, before, behind), unsure);
  }
  const auto real = hn::Gt(discriminant, graze);
  const auto root = hn::Sqrt(hn::Max(discriminant, graze));
  const auto sum = hn::IfThenElse(hn::Ge(b, zero), hn::Neg(hn::Add(b, root)), hn::Sub(root, b));
  const auto near = hn::Div(c, sum), far = hn::Div(sum, a);
  const auto first = hn::Min(near, far), second = hn::Max(near, far);
  auto enter = hn::Max(s.enter, first), leave = hn::Min(s.leave, second);
  auto hit = real;
  // Steeper than the side, which widens: outside between the roots, or inside all along.
  const auto steep = hn::Lt(a, zero);
  if (HWY_UNLIKELY(!hn::AllFalse(d, steep))) {
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
  // Along the axis of a side that does not widen, as far as the caps: the whole line is on one side.
  const auto share = r[p + ProfileRecord::parallel];
  const auto parallel = hn::And(hn::Le(across, hn::Mul(share, square)), hn::Gt(share, zero));
  if (HWY_UNLIKELY(!hn::AllFalse(d, parallel))) {
    const auto inside = hn::Lt(across_square, r[p + ProfileRecord::inside]);
    const auto outside = hn::Gt(across_square, r[p + ProfileRecord::outside]);
    enter = hn::IfThenElse(parallel, s.enter, enter);
    leave = hn::IfThenElse(parallel, s.leave, leave);
    hit = Choose(parallel, inside, hit);
    unsure = Choose(parallel, hn::Not(hn::Or(inside, outside)), unsure);
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

template <class D, class Record>
HWY_INLINE Stretch<D> UprightStretch(D d, const SceneRays<D>& ray, const Record& r, double least, double reach,
                                     hn::Vec<D> t_in, hn::Vec<D> t_out) {
  Vec3Lanes<D> o;
  const auto shift = Approach(ray, Sub3(ray.origin, Load3(d, r, UprightRecord::center)), o);
  constexpr std::size_t p = UprightRecord::profile;
  Stretch<D> s = WholeStretch(d);
  const auto high = r[p + ProfileRecord::high];
  ClipAligned(d, o.z, ray.slowness.z, r[p + ProfileRecord::low], high, s);
  if (HWY_UNLIKELY(ray.flat)) {
    const auto distance = hn::Sub(hn::Abs(o.z), high);
    s.unsure = DoubtFlat(d, ray.direction.z, ray.length, hn::Set(d, least), reach, distance);
  }
  ClipSide(d, ray, o, ray.direction, r, p, hn::Sub(t_in, shift), hn::Sub(t_out, shift), s);
  FinishStretch(d, ray, shift, s);
  return s;
}

template <class D, class Record>
HWY_INLINE Stretch<D> FrustumStretch(D d, const SceneRays<D>& ray, const Record& r, double reach, hn::Vec<D> t_in,
                                     hn::Vec<D> t_out) {
  Vec3Lanes<D> place;
  const auto shift = Approach(ray, Sub3(ray.origin, Load3(d, r, FrustumRecord::center)), place);
  const auto o = Map3(d, r, FrustumRecord::map, place), v = Map3(d, r, FrustumRecord::map, ray.direction);
  constexpr std::size_t p = FrustumRecord::profile;
  Stretch<D> s = WholeStretch(d);
  const auto high = r[p + ProfileRecord::high];
  ClipAligned(d, o.z, Slowness(d, v.z), r[p + ProfileRecord::low], high, s);
  const auto distance = hn::Sub(hn::Abs(o.z), high);
  s.unsure = DoubtFlat(d, v.z, ray.length, r[FrustumRecord::least], reach, distance);
  ClipSide(d, ray, o, v, r, p, hn::Sub(t_in, shift), hn::Sub(t_out, shift), s);
  FinishStretch(d, ray, shift, s);
  return s;
}

template <class D>
HWY_INLINE Stretch<D> ConvexStretch(D d, const SceneRays<D>& ray, const SharedRecord<D>& r, double reach) {
  Stretch<D> s = WholeStretch(d);
  const auto zero = hn::Zero(d);
  std::size_t plane = ConvexRecord::planes;
  for (auto left = static_cast<std::size_t>(std::fabs(r.values[ConvexRecord::count])); left > 0; --left) {
    const auto n = Load3(d, r, plane);
    const auto slope = FusedDot(n, ray.direction);
    const auto distance = hn::Sub(r[plane + 3], FusedDot(n, ray.origin));
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

/// All but a convex solid: of the two parts of a line that is met by that the one between two places. Where the solid's
/// ends are both there, or may be, neither is certain.
template <class D>
HWY_INLINE Stretch<D> NotchStretch(D d, const SceneRays<D>& ray, const SharedRecord<D>& r, double reach,
                                   hn::Vec<D> t_in, hn::Vec<D> t_out) {
  Stretch<D> s = ConvexStretch(d, ray, r, reach);
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  const auto least = ShortestStretch(d, ray);
  const auto meets_before = hn::Gt(s.enter, t_in), meets_after = hn::Lt(s.leave, t_out);
  const auto at_end =
      hn::Or(hn::Le(hn::Abs(hn::Sub(s.enter, t_in)), least), hn::Le(hn::Abs(hn::Sub(s.leave, t_out)), least));
  s.unsure = hn::Or(s.unsure, hn::And(s.hit, hn::Or(hn::And(meets_before, meets_after), at_end)));
  const auto after = hn::And(s.hit, hn::AndNot(meets_before, meets_after));
  const auto before = hn::And(s.hit, meets_before);
  const auto enter = hn::IfThenElse(after, s.leave, hn::Neg(infinity));
  const auto leave = hn::IfThenElse(before, s.enter, infinity);
  s.hit = hn::Or(hn::Not(s.hit), hn::Or(before, after));
  s.enter = enter;
  s.leave = leave;
  return s;
}

/// The stretch of any record.
/// @param kind         of the record, or the records
/// @param t_in, t_out  the part of each ray that matters: crossings elsewhere may be left out
/// @param lanes        the rays that matter
template <class D, class Record>
HWY_INLINE Stretch<D> FindStretch(D d, const SceneRays<D>& ray, RecordKind kind, const Record& r, double least_slope,
                                  double reach, hn::Vec<D> t_in, hn::Vec<D> t_out, hn::Mask<D> lanes) {
  switch (kind) {
    case RecordKind::ball:
      return BallStretch(d, ray, r);
    case RecordKind::aligned_box:
      return AlignedBoxStretch(d, ray, r, least_slope, reach);
    case RecordKind::box:
      return BoxStretch(d, ray, r, reach);
    case RecordKind::upright:
      return UprightStretch(d, ray, r, least_slope, reach, t_in, t_out);
    case RecordKind::frustum:
      return FrustumStretch(d, ray, r, reach, t_in, t_out);
    case RecordKind::convex:
      // Each has planes of its own number.
      if constexpr (std::is_same_v<Record, SharedRecord<D>>) return ConvexStretch(d, ray, r, reach);
      break;
    case RecordKind::notch:
      if constexpr (std::is_same_v<Record, SharedRecord<D>>) return NotchStretch(d, ray, r, reach, t_in, t_out);
      break;
    case RecordKind::outline:
      if constexpr (std::is_same_v<Record, SharedRecord<D>>) return OutlineStretch(d, ray, r, reach, t_in, t_out);
      break;
    case RecordKind::twisted:
      if constexpr (std::is_same_v<Record, SharedRecord<D>>)
        return TwistedStretch(d, ray, r, reach, t_in, t_out, lanes);
      break;
    case RecordKind::revolved:
      if constexpr (std::is_same_v<Record, SharedRecord<D>>) return RevolvedStretch(d, ray, r, t_in, t_out, lanes);
      break;
    case RecordKind::torus:
      return TorusStretch(d, ray, r, t_in, t_out, lanes);
    case RecordKind::general:
    case RecordKind::instance:
    case RecordKind::mesh:
    case RecordKind::convex_piece:
    case RecordKind::notch_piece:
    case RecordKind::outline_piece:
    case RecordKind::twisted_piece:
    case RecordKind::revolved_piece:
      break;
  }
  Stretch<D> none = WholeStretch(d);
  none.unsure = none.hit;
  return none;
}

template <class D>
HWY_INLINE Stretch<D> FindStretch(D d, const SceneRays<D>& ray, const LeafRecords& records, RecordRef ref, double reach,
                                  hn::Vec<D> t_in, hn::Vec<D> t_out, hn::Mask<D> lanes) {
  return FindStretch(d, ray, ref.kind(), SharedRecord<D>{records.values(ref)}, records.least_slope, reach, t_in, t_out,
                     lanes);
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
