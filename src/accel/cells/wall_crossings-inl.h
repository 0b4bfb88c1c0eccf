// Where rays cross the walls of an outline. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_WALL_CROSSINGS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_WALL_CROSSINGS_INL_H_
#undef TENON_ACCEL_CELLS_WALL_CROSSINGS_INL_H_
#else
#define TENON_ACCEL_CELLS_WALL_CROSSINGS_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "accel/cells/leaf_records.h"
#include "accel/cells/scene_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// The crossings of rays with the walls of a record, told apart from how the line of a wall goes on beyond its ends,
/// one ray a lane.
template <class D, class Record>
class WallCrossings {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// A place of the outline's plane, relative to the one that is known.
  struct Place {
    V x, y;
  };

  /// @param begin, end  what of the rays matters
  HWY_INLINE WallCrossings(const double* record, V begin, V end) : record_(record), begin_(begin), end_(end) {
    nowhere_ = hn::Set(D(), std::numeric_limits<double>::infinity());
    first_ = second_ = nowhere_;
    unsure_ = hn::Lt(nowhere_, nowhere_);
  }

  const double* record() const { return record_; }
  std::size_t count() const { return static_cast<std::size_t>(record_[WallsRecord::count]); }
  const double* wall(std::size_t i) const { return record_ + Record::walls + Record::wall_size * i; }
  V begin() const { return begin_; }
  V end() const { return end_; }
  V margin() const { return hn::Set(D(), record_[WallsRecord::margin]); }
  HWY_INLINE M IsWithin(V t) const { return hn::And(hn::Ge(t, begin_), hn::Le(t, end_)); }

  /// Says between which places of the plane the rays run.
  HWY_INLINE void RunBetween(const Place& lower, const Place& upper) {
    lower_ = lower;
    upper_ = upper;
  }
  /// Where rays may come near to a wall.
  HWY_INLINE M MayMeet(const double* wall) const { return Overlaps(wall, lower_, upper_); }

  HWY_INLINE void Doubt(M lanes) { unsure_ = hn::Or(unsure_, lanes); }

  /// Adds a crossing of a wall's line, if it belongs to the wall.
  /// @param x, y   its place in the plane, relative to the wall's first end
  /// @param scale  of the wall there
  HWY_INLINE void Take(const double* wall, V t, M within, V x, V y, V scale) {
    const D d;
    const double* chord = wall + WallsRecord::Wall::chord;
    if (wall[WallsRecord::Wall::curvature] == 0) {
      const V along = Dot(chord, x, y);
      const V rest = hn::Sub(hn::Mul(hn::Set(d, wall[WallsRecord::Wall::length]), scale), along);
      Take(t, within, hn::Min(along, rest));
    } else {
      Take(t, within, InwardOfArc(wall, x, y));
    }
  }

  /// The only part of the solid that each ray meets, cut from `slab`. Where it meets two, or crosses more than two
  /// walls, it is not sure.
  /// @param shift     what is added to the t of the crossings
  /// @param place_at  tells the Place at t
  template <class PlaceAt>
  HWY_INLINE Stretch<D> OnlyPart(const Stretch<D>& slab, V shift, V shortest, const PlaceAt& place_at) {
    const D d;
    const M starts_inside = StartsInside(place_at);
    // Inside up to the first crossing and from the second, or between the two.
    M unsure = hn::Or(slab.unsure, unsure_);
    const auto part = [&](M is_there, V enter, V leave) HWY_ATTR {
      Stretch<D> s{hn::Max(slab.enter, enter), hn::Min(slab.leave, leave), is_there, slab.unsure};
      s.hit = hn::And(s.hit, hn::And(hn::Le(s.enter, end_), hn::Ge(s.leave, begin_)));
      const V width = hn::Sub(s.leave, s.enter);
      unsure = hn::Or(unsure, hn::And(s.hit, hn::Le(hn::Abs(width), shortest)));
      s.hit = hn::And(s.hit, hn::Gt(width, hn::Zero(d)));
      return s;
    };
    const M is_crossed = hn::Lt(first_, nowhere_);
    const Stretch<D> one =
        part(hn::Or(starts_inside, is_crossed), hn::IfThenElse(starts_inside, hn::Neg(nowhere_), first_),
             hn::IfThenElse(starts_inside, first_, second_));
    const Stretch<D> other = part(hn::And(starts_inside, hn::Lt(second_, nowhere_)), second_, nowhere_);
    Stretch<D> s = slab;
    s.unsure = hn::Or(unsure, hn::And(one.hit, other.hit));
    s.hit = hn::Or(one.hit, other.hit);
    s.enter = hn::Add(shift, hn::IfThenElse(other.hit, other.enter, one.enter));
    s.leave = hn::Add(shift, hn::IfThenElse(other.hit, other.leave, one.leave));
    return s;
  }

  static HWY_INLINE V Dot(const double* n, V x, V y) {
    const D d;
    return hn::MulAdd(hn::Set(d, n[1]), y, hn::Mul(hn::Set(d, n[0]), x));
  }
  static HWY_INLINE V Square(V x, V y) { return hn::MulAdd(x, x, hn::Mul(y, y)); }

 private:
  // How far a place is on the arc's side of its chord.
  static HWY_INLINE V InwardOfArc(const double* wall, V x, V y) {
    const double* chord = wall + WallsRecord::Wall::chord;
    const double side = wall[WallsRecord::Wall::curvature] > 0 ? 1 : -1;
    const double right[2] = {side * chord[1], -side * chord[0]};
    return Dot(right, x, y);
  }

  // @param inward  how far the crossing is from the wall's ends
  HWY_INLINE void Take(V t, M within, V inward) {
    const M near_end = hn::And(within, hn::Le(hn::Abs(inward), margin()));
    const M taken = hn::And(within, hn::Gt(inward, margin()));
    const M full = hn::And(taken, hn::Lt(second_, nowhere_));
    Doubt(hn::Or(near_end, full));
    const V place = hn::IfThenElse(taken, t, nowhere_);
    const V later = hn::Max(first_, place);
    first_ = hn::Min(first_, place);
    second_ = hn::Min(second_, later);
  }

  // Whether the ray is inside before its first crossing: from the middle of the longest part between crossings, along
  // the straight way to the place of which that is known.
  template <class PlaceAt>
  HWY_INLINE M StartsInside(const PlaceAt& place_at) {
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
    const V t = hn::Mul(half, twice);
    M inside = record_[WallsRecord::is_inside] != 0 ? hn::Ge(nowhere_, nowhere_) : hn::Lt(nowhere_, nowhere_);
    const Place place = place_at(t), lower{hn::Min(place.x, zero), hn::Min(place.y, zero)},
                upper{hn::Max(place.x, zero), hn::Max(place.y, zero)};
    for (std::size_t i = 0; i < count(); ++i) {
      const M is_near = Overlaps(wall(i), lower, upper);
      if (!hn::AllFalse(d, is_near)) inside = hn::Xor(inside, IsPassed(wall(i), place, is_near));
    }
    return hn::Xor(inside, is_between);
  }

  static HWY_INLINE M Overlaps(const double* wall, const Place& lower, const Place& upper) {
    const D d;
    const double *low = wall + WallsRecord::Wall::lower, *high = wall + WallsRecord::Wall::upper;
    const M x = hn::And(hn::Le(lower.x, hn::Set(d, high[0])), hn::Ge(upper.x, hn::Set(d, low[0])));
    const M y = hn::And(hn::Le(lower.y, hn::Set(d, high[1])), hn::Ge(upper.y, hn::Set(d, low[1])));
    return hn::And(x, y);
  }

  // Whether the way from a place to the one that is known passes a wall an odd number of times.
  // @param asked  the rays of which it may
  HWY_INLINE M IsPassed(const double* wall, const Place& place, M asked) {
    const D d;
    const double *normal = wall + WallsRecord::Wall::normal, *chord = wall + WallsRecord::Wall::chord;
    const double* known = wall + WallsRecord::Wall::place;
    const V zero = hn::Zero(d), margin = hn::Set(d, record_[WallsRecord::place_margin]);
    const V x = hn::Add(place.x, hn::Set(d, known[0])), y = hn::Add(place.y, hn::Set(d, known[1]));
    const V way_x = hn::Neg(place.x), way_y = hn::Neg(place.y);
    const V last = hn::Set(d, wall[WallsRecord::Wall::at_place]);
    const V curvature = hn::Set(d, wall[WallsRecord::Wall::curvature]);
    const V value = hn::MulAdd(curvature, Square(x, y), Dot(normal, x, y));
    Doubt(hn::And(asked, hn::Le(hn::Abs(value), margin)));
    const auto passes = [&](V share, M is_there, V inward) HWY_ATTR {
      const M on_way = hn::And(hn::Gt(share, zero), hn::Lt(share, hn::Set(d, 1.0)));
      const M passed = hn::And(hn::And(asked, is_there), on_way);
      Doubt(hn::And(passed, hn::Le(hn::Abs(inward), margin)));
      return hn::And(passed, hn::Gt(inward, zero));
    };
    if (wall[WallsRecord::Wall::curvature] == 0) {
      const V share = hn::Div(value, hn::Sub(value, last));
      const V along = Dot(chord, hn::MulAdd(share, way_x, x), hn::MulAdd(share, way_y, y));
      const V rest = hn::Sub(hn::Set(d, wall[WallsRecord::Wall::length]), along);
      return passes(share, hn::Xor(hn::Lt(value, zero), hn::Lt(last, zero)), hn::Min(along, rest));
    }
    // value + share b + share² a, which is `last` at 1.
    const V a = hn::Mul(curvature, Square(way_x, way_y)), b = hn::Sub(hn::Sub(last, value), a);
    const V four_ac = hn::Mul(hn::Set(d, 4.0), hn::Mul(a, value)), bb = hn::Mul(b, b);
    const V discriminant = hn::Sub(bb, four_ac);
    // Far above what a few roundings of the terms make of it.
    const V doubt = hn::Mul(hn::Set(d, 0x1p-30), hn::Add(bb, hn::Abs(four_ac)));
    Doubt(hn::And(asked, hn::Le(hn::Abs(discriminant), doubt)));
    const M real = hn::Gt(discriminant, zero);
    const V root = hn::Sqrt(hn::Max(discriminant, zero)), minus_half = hn::Set(d, -0.5);
    const V q = hn::Mul(minus_half, hn::IfThenElse(hn::Lt(b, zero), hn::Sub(b, root), hn::Add(b, root)));
    const auto passes_at = [&](V share) HWY_ATTR {
      return passes(share, real, InwardOfArc(wall, hn::MulAdd(share, way_x, x), hn::MulAdd(share, way_y, y)));
    };
    return hn::Xor(passes_at(hn::Div(value, q)), passes_at(hn::Div(q, a)));
  }

  const double* record_;
  V begin_, end_, nowhere_;
  Place lower_, upper_;  // around the rays
  V first_, second_;     // infinite where there are none
  M unsure_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
