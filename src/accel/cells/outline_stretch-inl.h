// The stretches of outline records, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_OUTLINE_STRETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_OUTLINE_STRETCH_INL_H_
#undef TENON_ACCEL_CELLS_OUTLINE_STRETCH_INL_H_
#else
#define TENON_ACCEL_CELLS_OUTLINE_STRETCH_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/flat_rays-inl.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/scene_rays-inl.h"
#include "accel/cells/wall_crossings-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Rays through the part of a swept outline that lies in a cell (OutlineRecord).
template <class D>
class OutlineWalls {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// @param o, v        the rays in the leaf's frame, relative to the record's centre
  /// @param begin, end  what of them matters
  HWY_INLINE OutlineWalls(const double* record, const SceneRays<D>& ray, const Vec3Lanes<D>& o, const Vec3Lanes<D>& v,
                          V begin, V end)
      : crossings_(record, begin, end), ray_(ray), o_(o), v_(v) {
    const D d;
    least_ = hn::Mul(hn::Set(d, record[WallsRecord::least]), ray.length);
    slope_ = record[OutlineRecord::scale_slope];
    const V scale = hn::Set(d, record[OutlineRecord::scale]), slope = hn::Set(d, slope_);
    scale_ = hn::MulAdd(slope, o.z, scale);
    scale_change_ = hn::Mul(slope, v.z);
    const auto first = PlaceAt(begin), last = PlaceAt(end);
    crossings_.RunBetween({hn::Min(first.x, last.x), hn::Min(first.y, last.y)},
                          {hn::Max(first.x, last.x), hn::Max(first.y, last.y)});
  }

  HWY_INLINE void FindCrossings() {
    for (std::size_t i = 0; i < crossings_.count(); ++i) {
      const double* wall = crossings_.wall(i);
      if (hn::AllFalse(D(), crossings_.MayMeet(wall))) continue;
      if (wall[Wall::curvature] == 0) {
        CrossSegment(wall);
      } else {
        CrossArc(wall);
      }
    }
  }

  HWY_INLINE Stretch<D> OnlyPart(const Stretch<D>& slab, V shift, V shortest) {
    return crossings_.OnlyPart(slab, shift, shortest, [&](V t) HWY_ATTR { return PlaceAt(t); });
  }

 private:
  using Crossings = WallCrossings<D, OutlineRecord>;
  using Wall = WallsRecord::Wall;

  // The way of a ray relative to a place of the plane: place + t way, times the scale.
  struct Relative {
    V x, y, way_x, way_y;
  };

  V ScaleAt(V t) const { return hn::MulAdd(t, scale_change_, scale_); }

  // @param from, offset  the place, and where it is at the middle of the record's box
  HWY_INLINE Relative RelativeTo(const double* from, const double* offset) const {
    const D d;
    Relative r{hn::Sub(o_.x, hn::Set(d, offset[0])), hn::Sub(o_.y, hn::Set(d, offset[1])), v_.x, v_.y};
    if (slope_ == 0) return r;
    const V from_x = hn::Set(d, slope_ * from[0]), from_y = hn::Set(d, slope_ * from[1]);
    r.x = hn::NegMulAdd(from_x, o_.z, r.x);
    r.y = hn::NegMulAdd(from_y, o_.z, r.y);
    r.way_x = hn::NegMulAdd(from_x, v_.z, r.way_x);
    r.way_y = hn::NegMulAdd(from_y, v_.z, r.way_y);
    return r;
  }
  HWY_INLINE Relative RelativeTo(const double* wall) const {
    return RelativeTo(wall + OutlineRecord::from, wall + OutlineRecord::offset);
  }
  HWY_INLINE typename Crossings::Place PlaceAt(V t) const {
    const double* record = crossings_.record();
    const Relative r = RelativeTo(record + WallsRecord::known, record + OutlineRecord::known_offset);
    const V x = hn::MulAdd(t, r.way_x, r.x), y = hn::MulAdd(t, r.way_y, r.y);
    if (slope_ == 0) return {x, y};
    const V shrink = hn::Div(hn::Set(D(), 1.0), ScaleAt(t));
    return {hn::Mul(shrink, x), hn::Mul(shrink, y)};
  }

  HWY_INLINE void CrossSegment(const double* wall) {
    const D d;
    const Relative r = RelativeTo(wall);
    const double* normal = wall + Wall::normal;
    const V value = Crossings::Dot(normal, r.x, r.y), slope = Crossings::Dot(normal, r.way_x, r.way_y);
    const V t = hn::Neg(hn::Mul(value, Slowness(d, slope)));
    M within = crossings_.IsWithin(t);
    const M flat = hn::Le(hn::Abs(slope), least_);
    if (HWY_UNLIKELY(!hn::AllFalse(d, flat))) {
      // It stays on one side, away from the wall, or nobody knows.
      const V at_begin = hn::MulAdd(crossings_.begin(), slope, value);
      const V at_end = hn::MulAdd(crossings_.end(), slope, value), margin = crossings_.margin();
      const M beside =
          hn::Or(hn::Gt(hn::Min(at_begin, at_end), margin), hn::Lt(hn::Max(at_begin, at_end), hn::Neg(margin)));
      crossings_.Doubt(hn::AndNot(beside, flat));
      within = hn::AndNot(flat, within);
    }
    Take(wall, r, t, within);
  }

  HWY_INLINE void CrossArc(const double* wall) {
    const D d;
    const Relative r = RelativeTo(wall);
    const double* normal = wall + Wall::normal;
    const V curvature = hn::Set(d, wall[Wall::curvature]), half = hn::Set(d, 0.5), zero = hn::Zero(d);
    const V value = Crossings::Dot(normal, r.x, r.y), slope = Crossings::Dot(normal, r.way_x, r.way_y);
    const V a = hn::MulAdd(curvature, Crossings::Square(r.way_x, r.way_y), hn::Mul(slope, scale_change_));
    const V b = hn::MulAdd(curvature, hn::MulAdd(r.x, r.way_x, hn::Mul(r.y, r.way_y)),
                           hn::Mul(half, hn::MulAdd(value, scale_change_, hn::Mul(slope, scale_))));
    const V c = hn::MulAdd(curvature, Crossings::Square(r.x, r.y), hn::Mul(value, scale_));
    const V discriminant = hn::MulSub(b, b, hn::Mul(a, c));
    const V graze = hn::Mul(hn::Set(d, wall[OutlineRecord::graze]), hn::Mul(ray_.length, ray_.length));
    const M doubtful = hn::Le(hn::Abs(discriminant), graze);
    if (HWY_UNLIKELY(!hn::AllFalse(d, doubtful))) {
      crossings_.Doubt(hn::AndNot(GrazesElsewhere(d, a, b, graze, crossings_.begin(), crossings_.end()), doubtful));
    }
    const M real = hn::Gt(discriminant, graze);
    if (hn::AllFalse(d, real)) return;
    const V root = hn::Sqrt(hn::Max(discriminant, graze));
    const V sum = hn::IfThenElse(hn::Ge(b, zero), hn::Neg(hn::Add(b, root)), hn::Sub(root, b));
    for (const V t : {hn::Div(c, sum), hn::Div(sum, a)}) Take(wall, r, t, hn::And(real, crossings_.IsWithin(t)));
  }

  HWY_INLINE void Take(const double* wall, const Relative& r, V t, M within) {
    if (hn::AllFalse(D(), within)) return;
    crossings_.Take(wall, t, within, hn::MulAdd(t, r.way_x, r.x), hn::MulAdd(t, r.way_y, r.y), ScaleAt(t));
  }

  Crossings crossings_;
  const SceneRays<D>& ray_;
  const Vec3Lanes<D>&o_, &v_;
  V least_;                 // slope across a wall
  V scale_, scale_change_;  // of the outline, at o and along v
  double slope_;            // of the scale along z
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

  const Stretch<D> slab = BetweenCaps(d, o.z, v.z, ray.length, r[OutlineRecord::low], r[OutlineRecord::high],
                                      r[OutlineRecord::least_to_caps], reach);
  OutlineWalls<D> walls(r.values, ray, o, v, begin, end);
  walls.FindCrossings();
  return walls.OnlyPart(slab, shift, shortest);
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
