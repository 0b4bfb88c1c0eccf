// The stretches of outline records, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_OUTLINE_STRETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_OUTLINE_STRETCH_INL_H_
#undef TENON_ACCEL_CELLS_OUTLINE_STRETCH_INL_H_
#else
#define TENON_ACCEL_CELLS_OUTLINE_STRETCH_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "accel/cells/flat_rays-inl.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/scene_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Rays through the part of a swept outline that lies in a cell (OutlineRecord): where they cross its walls, told apart
/// from how the line of a wall goes on beyond its ends.
template <class D>
class OutlineWalls {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// @param o, v        the rays in the leaf's frame, relative to the record's centre
  /// @param begin, end  what of them matters
  HWY_INLINE OutlineWalls(const double* record, const SceneRays<D>& ray, const Vec3Lanes<D>& o, const Vec3Lanes<D>& v,
                          V begin, V end)
      : record_(record), ray_(ray), o_(o), v_(v), begin_(begin), end_(end) {
    const D d;
    nowhere_ = hn::Set(d, std::numeric_limits<double>::infinity());
    first_ = second_ = nowhere_;
    unsure_ = hn::Lt(nowhere_, nowhere_);
    slope_ = record[OutlineRecord::scale_slope];
    const V scale = hn::Set(d, record[OutlineRecord::scale]), slope = hn::Set(d, slope_);
    scale_ = hn::MulAdd(slope, o.z, scale);
    scale_change_ = hn::Mul(slope, v.z);
  }

  HWY_INLINE void FindCrossings() {
    for (std::size_t i = 0; i < count(); ++i) {
      const double* wall = this->wall(i);
      if (wall[OutlineRecord::curvature] == 0) {
        CrossSegment(wall);
      } else {
        CrossArc(wall);
      }
    }
  }

  /// The first two crossings; infinite where there are none.
  V first() const { return first_; }
  V second() const { return second_; }
  /// Where something about the crossings is not certain.
  M unsure() const { return unsure_; }

  /// Whether the ray is inside of the outline before its first crossing: from the middle of the longest part between
  /// crossings, along the straight way to a place of which that is known.
  HWY_INLINE M StartsInside() {
    const D d;
    const V zero = hn::Zero(d), half = hn::Set(d, 0.5);
    const M has_first = hn::Lt(first_, nowhere_), has_second = hn::Lt(second_, nowhere_);
    const V end_of_first = hn::Min(first_, end_), end_of_second = hn::Min(second_, end_);
    const V before = hn::Sub(end_of_first, begin_);
    const V between = hn::IfThenElse(has_first, hn::Sub(end_of_second, first_), zero);
    const V behind = hn::IfThenElse(has_second, hn::Sub(end_, second_), zero);
    const M is_before = hn::And(hn::Ge(before, between), hn::Ge(before, behind));
    const M is_between = hn::AndNot(is_before, hn::Ge(between, behind));
    V twice = hn::Add(begin_, end_of_first);
    twice = hn::IfThenElse(is_between, hn::Add(first_, end_of_second), twice);
    const M is_behind = hn::AndNot(hn::Or(is_before, is_between), has_second);
    twice = hn::IfThenElse(is_behind, hn::Add(second_, end_), twice);
    const M is_inside = IsInside(hn::Mul(half, twice));
    return hn::Xor(is_inside, is_between);
  }

 private:
  // The way of a ray relative to the first end of a wall: place + t way.
  struct Relative {
    V x, y, way_x, way_y;
  };

  std::size_t count() const { return static_cast<std::size_t>(record_[OutlineRecord::count]); }
  const double* wall(std::size_t i) const { return record_ + OutlineRecord::walls + OutlineRecord::wall_size * i; }

  HWY_INLINE Relative RelativeTo(const double* wall) const {
    const D d;
    Relative r{hn::Sub(o_.x, hn::Set(d, wall[OutlineRecord::offset])),
               hn::Sub(o_.y, hn::Set(d, wall[OutlineRecord::offset + 1])), v_.x, v_.y};
    if (slope_ == 0) return r;
    const V from_x = hn::Set(d, slope_ * wall[OutlineRecord::from]);
    const V from_y = hn::Set(d, slope_ * wall[OutlineRecord::from + 1]);
    r.x = hn::NegMulAdd(from_x, o_.z, r.x);
    r.y = hn::NegMulAdd(from_y, o_.z, r.y);
    r.way_x = hn::NegMulAdd(from_x, v_.z, r.way_x);
    r.way_y = hn::NegMulAdd(from_y, v_.z, r.way_y);
    return r;
  }
  static HWY_INLINE V Dot(const double* n, V x, V y) {
    const D d;
    return hn::MulAdd(hn::Set(d, n[1]), y, hn::Mul(hn::Set(d, n[0]), x));
  }
  /// To the right of a chord.
  static HWY_INLINE V Right(const double* chord, V x, V y) {
    const double right[2] = {chord[1], -chord[0]};
    return Dot(right, x, y);
  }
  HWY_INLINE M IsWithin(V t) const { return hn::And(hn::Ge(t, begin_), hn::Le(t, end_)); }
  HWY_INLINE V margin() const { return hn::Set(D(), record_[OutlineRecord::margin]); }

  HWY_INLINE void CrossSegment(const double* wall) {
    const D d;
    const Relative r = RelativeTo(wall);
    const double *normal = wall + OutlineRecord::normal, *chord = wall + OutlineRecord::chord;
    const V value = Dot(normal, r.x, r.y), slope = Dot(normal, r.way_x, r.way_y);
    const V t = hn::Neg(hn::Mul(value, Slowness(d, slope)));
    M within = IsWithin(t);
    const M flat = hn::Le(hn::Abs(slope), hn::Mul(hn::Set(d, record_[OutlineRecord::least]), ray_.length));
    if (HWY_UNLIKELY(!hn::AllFalse(d, flat))) {
      // It stays on one side, away from the wall, or nobody knows.
      const V at_begin = hn::MulAdd(begin_, slope, value), at_end = hn::MulAdd(end_, slope, value);
      const M beside =
          hn::Or(hn::Gt(hn::Min(at_begin, at_end), margin()), hn::Lt(hn::Max(at_begin, at_end), hn::Neg(margin())));
      unsure_ = hn::Or(unsure_, hn::AndNot(beside, flat));
      within = hn::AndNot(flat, within);
    }
    if (hn::AllFalse(d, within)) return;
    const V along = Dot(chord, hn::MulAdd(t, r.way_x, r.x), hn::MulAdd(t, r.way_y, r.y));
    const V scale = hn::MulAdd(t, scale_change_, scale_);
    const V rest = hn::Sub(hn::Mul(hn::Set(d, wall[OutlineRecord::length]), scale), along);
    Take(t, within, hn::Min(along, rest));
  }

  HWY_INLINE void CrossArc(const double* wall) {
    const D d;
    const Relative r = RelativeTo(wall);
    const double* normal = wall + OutlineRecord::normal;
    const V curvature = hn::Set(d, wall[OutlineRecord::curvature]), half = hn::Set(d, 0.5), zero = hn::Zero(d);
    const V value = Dot(normal, r.x, r.y), slope = Dot(normal, r.way_x, r.way_y);
    const V a = hn::MulAdd(curvature, Square(r.way_x, r.way_y), hn::Mul(slope, scale_change_));
    const V b = hn::MulAdd(curvature, hn::MulAdd(r.x, r.way_x, hn::Mul(r.y, r.way_y)),
                           hn::Mul(half, hn::MulAdd(value, scale_change_, hn::Mul(slope, scale_))));
    const V c = hn::MulAdd(curvature, Square(r.x, r.y), hn::Mul(value, scale_));
    const V discriminant = hn::MulSub(b, b, hn::Mul(a, c));
    const V graze = hn::Mul(hn::Set(d, wall[OutlineRecord::graze]), hn::Mul(ray_.length, ray_.length));
    const M doubtful = hn::Le(hn::Abs(discriminant), graze);
    if (HWY_UNLIKELY(!hn::AllFalse(d, doubtful))) {
      unsure_ = hn::Or(unsure_, hn::AndNot(GrazesElsewhere(d, a, b, graze, begin_, end_), doubtful));
    }
    const M real = hn::Gt(discriminant, graze);
    if (hn::AllFalse(d, real)) return;
    const V root = hn::Sqrt(hn::Max(discriminant, graze));
    const V sum = hn::IfThenElse(hn::Ge(b, zero), hn::Neg(hn::Add(b, root)), hn::Sub(root, b));
    const double* chord = wall + OutlineRecord::chord;
    const V side = wall[OutlineRecord::curvature] > 0 ? hn::Set(d, 1.0) : hn::Set(d, -1.0);
    for (const V t : {hn::Div(c, sum), hn::Div(sum, a)}) {
      const M within = hn::And(real, IsWithin(t));
      if (hn::AllFalse(d, within)) continue;
      // The arc lies on one side of its chord.
      const V right = Right(chord, hn::MulAdd(t, r.way_x, r.x), hn::MulAdd(t, r.way_y, r.y));
      Take(t, within, hn::Mul(side, right));
    }
  }

  static HWY_INLINE V Square(V x, V y) { return hn::MulAdd(x, x, hn::Mul(y, y)); }

  /// Adds a crossing of a wall's line, if it belongs to the wall. @param inward  how far it is from the wall's ends
  HWY_INLINE void Take(V t, M within, V inward) {
    const M near_end = hn::And(within, hn::Le(hn::Abs(inward), margin()));
    const M taken = hn::And(within, hn::Gt(inward, margin()));
    const M full = hn::And(taken, hn::Lt(second_, nowhere_));
    unsure_ = hn::Or(unsure_, hn::Or(near_end, full));
    const V place = hn::IfThenElse(taken, t, nowhere_);
    const V later = hn::Max(first_, place);
    first_ = hn::Min(first_, place);
    second_ = hn::Min(second_, later);
  }

  /// Whether the ray is inside of the outline at t.
  HWY_INLINE M IsInside(V t) {
    const D d;
    M inside = record_[OutlineRecord::is_inside] != 0 ? hn::Ge(nowhere_, nowhere_) : hn::Lt(nowhere_, nowhere_);
    V shrink = hn::Set(d, 1.0);
    if (slope_ != 0) shrink = hn::Div(shrink, hn::MulAdd(t, scale_change_, scale_));
    for (std::size_t i = 0; i < count(); ++i) {
      const double* wall = this->wall(i);
      const Relative r = RelativeTo(wall);
      const V x = hn::Mul(shrink, hn::MulAdd(t, r.way_x, r.x)), y = hn::Mul(shrink, hn::MulAdd(t, r.way_y, r.y));
      inside = hn::Xor(inside, IsPassed(wall, x, y));
    }
    return inside;
  }

  /// Whether the way from a place, relative to a wall, to the place that is known passes the wall an odd number of
  /// times.
  HWY_INLINE M IsPassed(const double* wall, V x, V y) {
    const D d;
    const double *normal = wall + OutlineRecord::normal, *chord = wall + OutlineRecord::chord;
    const double* known = wall + OutlineRecord::place;
    const V zero = hn::Zero(d), margin = hn::Set(d, record_[OutlineRecord::place_margin]);
    const V way_x = hn::Sub(hn::Set(d, known[0]), x), way_y = hn::Sub(hn::Set(d, known[1]), y);
    const V last = hn::Set(d, wall[OutlineRecord::at_place]);
    const V curvature = hn::Set(d, wall[OutlineRecord::curvature]);
    const V value = hn::MulAdd(curvature, Square(x, y), Dot(normal, x, y));
    unsure_ = hn::Or(unsure_, hn::Le(hn::Abs(value), margin));
    const auto passes = [&](V share, M is_there, V inward) HWY_ATTR {
      const M passed = hn::And(is_there, hn::And(hn::Gt(share, zero), hn::Lt(share, hn::Set(d, 1.0))));
      unsure_ = hn::Or(unsure_, hn::And(passed, hn::Le(hn::Abs(inward), margin)));
      return hn::And(passed, hn::Gt(inward, zero));
    };
    if (wall[OutlineRecord::curvature] == 0) {
      const V share = hn::Div(value, hn::Sub(value, last));
      const V along = Dot(chord, hn::MulAdd(share, way_x, x), hn::MulAdd(share, way_y, y));
      const V rest = hn::Sub(hn::Set(d, wall[OutlineRecord::length]), along);
      return passes(share, hn::Xor(hn::Lt(value, zero), hn::Lt(last, zero)), hn::Min(along, rest));
    }
    // value + share b + share² a, which is `last` at 1.
    const V a = hn::Mul(curvature, Square(way_x, way_y)), b = hn::Sub(hn::Sub(last, value), a);
    const V four_ac = hn::Mul(hn::Set(d, 4.0), hn::Mul(a, value)), bb = hn::Mul(b, b);
    const V discriminant = hn::Sub(bb, four_ac);
    // Far above what a few roundings of the terms make of it.
    const V doubt = hn::Mul(hn::Set(d, 0x1p-30), hn::Add(bb, hn::Abs(four_ac)));
    unsure_ = hn::Or(unsure_, hn::Le(hn::Abs(discriminant), doubt));
    const M real = hn::Gt(discriminant, zero);
    const V root = hn::Sqrt(hn::Max(discriminant, zero)), minus_half = hn::Set(d, -0.5);
    const V q = hn::Mul(minus_half, hn::IfThenElse(hn::Lt(b, zero), hn::Sub(b, root), hn::Add(b, root)));
    const V side = wall[OutlineRecord::curvature] > 0 ? hn::Set(d, 1.0) : hn::Set(d, -1.0);
    const auto passes_at = [&](V share) HWY_ATTR {
      const V right = Right(chord, hn::MulAdd(share, way_x, x), hn::MulAdd(share, way_y, y));
      return passes(share, real, hn::Mul(side, right));
    };
    return hn::Xor(passes_at(hn::Div(value, q)), passes_at(hn::Div(q, a)));
  }

  const double* record_;
  const SceneRays<D>& ray_;
  const Vec3Lanes<D>&o_, &v_;
  V begin_, end_, nowhere_;
  V scale_, scale_change_;  // of the outline, at o and along v
  double slope_;            // of the scale along z
  V first_, second_;
  M unsure_;
};

/// The only part of a swept outline that a ray meets from t_in to t_out. Where it meets two, or crosses more than two
/// walls, it is not sure.
template <class D>
HWY_INLINE Stretch<D> OutlineStretch(D d, const SceneRays<D>& ray, const SharedRecord<D>& r, double reach,
                                     hn::Vec<D> t_in, hn::Vec<D> t_out) {
  Vec3Lanes<D> place;
  const auto shift = Approach(ray, Sub3(ray.origin, Load3(d, r, OutlineRecord::center)), place);
  const auto o = Map3(d, r, OutlineRecord::map, place), v = Map3(d, r, OutlineRecord::map, ray.direction);
  // What is that near to another boundary may be one with it.
  const auto shortest = ShortestStretch(d, ray);
  const auto begin = hn::Sub(hn::Sub(t_in, shift), shortest), end = hn::Add(hn::Sub(t_out, shift), shortest);

  Stretch<D> slab = WholeStretch(d);
  const auto low = r[OutlineRecord::low], high = r[OutlineRecord::high];
  ClipAligned(d, o.z, Slowness(d, v.z), low, high, slab);
  const auto to_cap = hn::Min(hn::Abs(hn::Sub(o.z, low)), hn::Abs(hn::Sub(high, o.z)));
  slab.unsure = DoubtFlat(d, v.z, ray.length, r[OutlineRecord::least_to_caps], reach, to_cap);

  OutlineWalls<D> walls(r.values, ray, o, v, begin, end);
  walls.FindCrossings();
  const auto starts_inside = walls.StartsInside();
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  const auto first = walls.first(), second = walls.second();
  // Inside up to the first crossing and from the second, or between the two.
  auto unsure = hn::Or(slab.unsure, walls.unsure());
  const auto part = [&](hn::Mask<D> is_there, hn::Vec<D> enter, hn::Vec<D> leave) HWY_ATTR {
    Stretch<D> s{hn::Max(slab.enter, enter), hn::Min(slab.leave, leave), is_there, slab.unsure};
    s.hit = hn::And(s.hit, hn::And(hn::Le(s.enter, end), hn::Ge(s.leave, begin)));
    const auto width = hn::Sub(s.leave, s.enter);
    unsure = hn::Or(unsure, hn::And(s.hit, hn::Le(hn::Abs(width), shortest)));
    s.hit = hn::And(s.hit, hn::Gt(width, hn::Zero(d)));
    return s;
  };
  const auto is_crossed = hn::Lt(first, infinity);
  const Stretch<D> one =
      part(hn::Or(starts_inside, is_crossed), hn::IfThenElse(starts_inside, hn::Neg(infinity), first),
           hn::IfThenElse(starts_inside, first, second));
  const Stretch<D> other = part(hn::And(starts_inside, hn::Lt(second, infinity)), second, infinity);
  Stretch<D> s = slab;
  s.unsure = hn::Or(unsure, hn::And(one.hit, other.hit));
  s.hit = hn::Or(one.hit, other.hit);
  s.enter = hn::Add(shift, hn::IfThenElse(other.hit, other.enter, one.enter));
  s.leave = hn::Add(shift, hn::IfThenElse(other.hit, other.leave, one.leave));
  return s;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
