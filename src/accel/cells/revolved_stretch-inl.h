// The stretches of revolved records, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_REVOLVED_STRETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_REVOLVED_STRETCH_INL_H_
#undef TENON_ACCEL_CELLS_REVOLVED_STRETCH_INL_H_
#else
#define TENON_ACCEL_CELLS_REVOLVED_STRETCH_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "accel/cells/flat_rays-inl.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/scene_rays-inl.h"
#include "accel/cells/wall_crossings-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Rays through the part of a turned outline that lies in a cell (RevolvedRecord).
///
/// In the half-plane of the outline a ray is a branch of a hyperbola, (ρ(t), z(t)), and ρ'' = across nearest² / ρ³ of
/// one that comes as near to the axis as `nearest`, `across` being the square of its speed across the axis. What a
/// wall's record says of a place, f = curvature |p|² + normal·p, is convex along the ray where that is a segment, for
/// its normal points away from the axis; and of an arc of radius r around (c, z0), f = (|p - centre|² - r²) / 2r,
///
///   r f'' = ρ'² + z'² + (ρ - c) ρ'' = |direction|² - across c nearest² / ρ³
///
/// So f is convex where ρ is above some bound, and -f below. Either way a wall's line is crossed twice at most, and
/// Newton's method goes to a crossing from outside without passing it.
template <class D>
class RevolvedWalls {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// @param o, v        the rays in the leaf's frame, o relative to the axis, and along it to the record's centre
  /// @param begin, end  what of them matters
  /// @param lanes       the rays that matter
  HWY_INLINE RevolvedWalls(const double* record, const SceneRays<D>& ray, const Vec3Lanes<D>& o, const Vec3Lanes<D>& v,
                           V begin, V end, M lanes)
      : crossings_(record, begin, end), ray_(ray), o_(o), v_(v), lanes_(lanes) {
    const D d;
    across_ = Crossings::Square(v.x, v.y);
    least_ = hn::Mul(hn::Set(d, record[WallsRecord::least]), ray.length);
    doubt_ = hn::Set(d, record[RevolvedRecord::doubt]);
    first_ = At(begin);
    last_ = At(end);
    const V nearest = hn::Neg(hn::Mul(hn::MulAdd(o.x, v.x, hn::Mul(o.y, v.y)), Slowness(d, across_)));
    const Place inmost = At(hn::Max(begin, hn::Min(nearest, end)));
    const V least = inmost.radius, most = hn::Max(first_.radius, last_.radius);
    crossings_.RunBetween({inmost.x, hn::Min(first_.y, last_.y)},
                          {hn::Max(first_.x, last_.x), hn::Max(first_.y, last_.y)});
    least_cube_ = hn::Mul(hn::Mul(least, least), least);
    most_cube_ = hn::Mul(hn::Mul(most, most), most);
    const V square = Crossings::Square(hn::MulAdd(nearest, v.x, o.x), hn::MulAdd(nearest, v.y, o.y));
    turn_ = hn::Div(hn::Mul(across_, square), hn::MulAdd(v.z, v.z, across_));
  }

  HWY_INLINE void FindCrossings() {
    for (std::size_t i = 0; i < crossings_.count(); ++i) {
      const double* wall = crossings_.wall(i);
      const M lanes = hn::And(lanes_, crossings_.MayMeet(wall));
      if (!hn::AllFalse(D(), lanes)) Cross(wall, lanes);
    }
  }

  HWY_INLINE Stretch<D> OnlyPart(V shift, V shortest) {
    return crossings_.OnlyPart(WholeStretch(D()), shift, shortest, [&](V t) HWY_ATTR {
      const Place p = At(t);
      return typename Crossings::Place{p.x, p.y};
    });
  }

 private:
  using Crossings = WallCrossings<D, RevolvedRecord>;
  using Wall = WallsRecord::Wall;

  // Of a ray in the half-plane, relative to the place that is known, and how fast it goes away from the axis.
  struct Place {
    V t, x, y, radius, rise;
  };
  // f there, or -f, and its slope.
  struct Value {
    V f, slope;
  };

  HWY_INLINE Place At(V t) const {
    const D d;
    const V x = hn::MulAdd(t, v_.x, o_.x), y = hn::MulAdd(t, v_.y, o_.y);
    const V radius = hn::Sqrt(Crossings::Square(x, y));
    const V rise =
        hn::Div(hn::MulAdd(x, v_.x, hn::Mul(y, v_.y)), hn::Max(radius, hn::Set(d, std::numeric_limits<double>::min())));
    const double* known = crossings_.record() + WallsRecord::known;
    return {t, hn::Sub(radius, hn::Set(d, known[0])), hn::Sub(hn::MulAdd(t, v_.z, o_.z), hn::Set(d, known[1])), radius,
            rise};
  }
  static HWY_INLINE V X(const double* wall, const Place& p) { return hn::Add(p.x, hn::Set(D(), wall[Wall::place])); }
  static HWY_INLINE V Y(const double* wall, const Place& p) {
    return hn::Add(p.y, hn::Set(D(), wall[Wall::place + 1]));
  }
  HWY_INLINE Value ValueAt(const double* wall, const Place& p) const {
    const D d;
    const V x = X(wall, p), y = Y(wall, p);
    const V n_x = hn::Set(d, wall[Wall::normal]), n_y = hn::Set(d, wall[Wall::normal + 1]);
    const V curvature = hn::Set(d, wall[Wall::curvature]);
    // The gradient is normal + 2 curvature p.
    const V c_x = hn::Mul(curvature, x), c_y = hn::Mul(curvature, y);
    const V half_x = hn::Add(n_x, c_x), half_y = hn::Add(n_y, c_y);
    const V g_x = hn::Add(half_x, c_x), g_y = hn::Add(half_y, c_y);
    return {hn::Mul(sign_, hn::MulAdd(half_x, x, hn::Mul(half_y, y))),
            hn::Mul(sign_, hn::MulAdd(g_x, p.rise, hn::Mul(g_y, v_.z)))};
  }
  // Bound on the slope of the slope.
  HWY_INLINE V BendAt(const double* wall, const Place& p) const {
    const D d;
    const V twice = hn::Set(d, 2 * wall[Wall::curvature]);
    const V g_x = hn::MulAdd(twice, X(wall, p), hn::Set(d, wall[Wall::normal]));
    const V rise_square = hn::Mul(p.rise, p.rise);
    const V turn = hn::Div(hn::Max(hn::Sub(across_, rise_square), hn::Zero(d)),
                           hn::Max(p.radius, hn::Set(d, std::numeric_limits<double>::min())));
    return hn::MulAdd(twice, hn::MulAdd(v_.z, v_.z, rise_square), hn::Mul(hn::Abs(g_x), turn));
  }

  // 1 where f is convex all along the ray, -1 where -f is.
  HWY_INLINE V SignOf(const double* wall, M lanes) {
    const D d;
    const V one = hn::Set(d, 1.0);
    const double center = wall[RevolvedRecord::center_radius];
    if (!(center > 0)) return one;
    const V bound = hn::Mul(hn::Set(d, center), turn_);
    const M is_above = hn::Ge(least_cube_, bound), is_below = hn::Le(most_cube_, bound);
    crossings_.Doubt(hn::AndNot(hn::Or(is_above, is_below), lanes));
    return hn::IfThenElse(is_above, one, hn::Neg(one));
  }

  HWY_INLINE void Cross(const double* wall, M lanes) {
    const D d;
    const V zero = hn::Zero(d);
    sign_ = SignOf(wall, lanes);
    const Value first = ValueAt(wall, first_), last = ValueAt(wall, last_);
    const M outside_first = hn::Gt(first.f, zero), outside_last = hn::Gt(last.f, zero);
    // It runs along the wall.
    const auto lies_along = [&](const Value& at) HWY_ATTR {
      return hn::And(hn::Le(hn::Abs(at.f), crossings_.margin()), hn::Le(hn::Abs(at.slope), least_));
    };
    crossings_.Doubt(hn::And(lanes, hn::Or(lies_along(first), lies_along(last))));
    M from_first = hn::And(lanes, hn::AndNot(outside_last, outside_first));
    M from_last = hn::And(lanes, hn::AndNot(outside_first, outside_last));
    const M turns = hn::And(hn::Lt(first.slope, zero), hn::Gt(last.slope, zero));
    M dips = hn::And(hn::And(lanes, turns), hn::And(outside_first, outside_last));
    if (!hn::AllFalse(d, dips)) {
      dips = Dips(wall, first, last, dips);
      from_first = hn::Or(from_first, dips);
      from_last = hn::Or(from_last, dips);
    }
    if (!hn::AllFalse(d, from_first)) Approach(wall, first_, first, from_first);
    if (!hn::AllFalse(d, from_last)) Approach(wall, last_, last, from_last);
  }

  /// Which of the rays that begin and end outside of a wall's line are within it between. By the place where tangents
  /// of f meet, below which it does not go.
  HWY_NOINLINE M Dips(const double* wall, const Value& first, const Value& last, M asked) {
    const D d;
    Value low = first, high = last;
    V low_t = first_.t, high_t = last_.t;
    M dips = hn::Lt(doubt_, hn::Neg(doubt_));  // none
    for (int round = 0; round < 12; ++round) {
      const V span = hn::Sub(high_t, low_t);
      const V share = hn::Div(hn::Sub(hn::NegMulAdd(high.slope, span, high.f), low.f), hn::Sub(low.slope, high.slope));
      const V t = hn::Min(hn::Max(hn::Add(low_t, share), low_t), high_t);
      const V bound = hn::MulAdd(hn::Sub(t, low_t), low.slope, low.f);
      asked = hn::And(asked, hn::Le(bound, doubt_));
      if (hn::AllFalse(d, asked)) return dips;
      const Value middle = ValueAt(wall, At(t));
      const M below = hn::And(asked, hn::Lt(middle.f, hn::Neg(doubt_)));
      dips = hn::Or(dips, below);
      asked = hn::AndNot(below, asked);
      const M near = hn::And(asked, hn::Le(middle.f, doubt_));
      crossings_.Doubt(near);
      asked = hn::AndNot(near, asked);
      const M falls = hn::Lt(middle.slope, hn::Zero(d));
      low = {hn::IfThenElse(falls, middle.f, low.f), hn::IfThenElse(falls, middle.slope, low.slope)};
      high = {hn::IfThenElse(falls, high.f, middle.f), hn::IfThenElse(falls, high.slope, middle.slope)};
      low_t = hn::IfThenElse(falls, t, low_t);
      high_t = hn::IfThenElse(falls, high_t, t);
    }
    crossings_.Doubt(asked);
    return dips;
  }

  /// Goes from a place outside of a wall's line to where the ray crosses it.
  HWY_INLINE void Approach(const double* wall, Place at, Value value, M lanes) {
    const D d;
    const V small = hn::Mul(hn::Set(d, 0x1p-12), ray_.near);
    M moves = lanes;
    for (int round = 0; round < 20 && !hn::AllFalse(d, moves); ++round) {
      const V step = hn::Neg(hn::Mul(value.f, Slowness(d, value.slope)));
      const V t = hn::Min(hn::Max(hn::Add(at.t, step), crossings_.begin()), crossings_.end());
      moves = hn::And(moves, hn::Gt(hn::Abs(step), small));
      at = At(t);
      value = ValueAt(wall, at);
    }
    // Its slope is large against errors, and changes little within them.
    const V least = hn::Max(least_, hn::Mul(BendAt(wall, at), ray_.near));
    crossings_.Doubt(hn::And(lanes, hn::Or(moves, hn::Le(hn::Abs(value.slope), least))));
    crossings_.Take(wall, at.t, lanes, X(wall, at), Y(wall, at), hn::Set(d, 1.0));
  }

  Crossings crossings_;
  const SceneRays<D>& ray_;
  const Vec3Lanes<D>&o_, &v_;
  const M lanes_;
  V across_;                  // the square of the direction's length across the axis
  V least_cube_, most_cube_;  // of the radius
  V turn_;                    // across nearest² / |direction|²
  V least_, doubt_, sign_ = hn::Set(D(), 1.0);
  Place first_, last_;
};

/// The only part of a turned outline that a ray meets from t_in to t_out. Where it meets two, or crosses more than two
/// walls, it is not sure. Not a part of its callers: that would slow down what they do in cells of other kinds.
template <class D>
HWY_NOINLINE Stretch<D> RevolvedStretch(D d, const SceneRays<D>& ray, const SharedRecord<D>& r, hn::Vec<D> t_in,
                                        hn::Vec<D> t_out, hn::Mask<D> lanes) {
  Vec3Lanes<D> place;
  const auto shift = Approach(ray, Sub3(ray.origin, Load3(d, r, WallsRecord::center)), place);
  auto o = Map3(d, r, WallsRecord::map, place);
  const auto v = Map3(d, r, WallsRecord::map, ray.direction);
  o.x = hn::Add(o.x, r[RevolvedRecord::middle]);
  o.y = hn::Add(o.y, r[RevolvedRecord::middle + 1]);
  // What is that near to another boundary may be one with it.
  const auto shortest = ShortestStretch(d, ray);
  const auto begin = hn::Sub(hn::Sub(t_in, shift), shortest), end = hn::Add(hn::Sub(t_out, shift), shortest);
  RevolvedWalls<D> walls(r.values, ray, o, v, begin, end, lanes);
  walls.FindCrossings();
  return walls.OnlyPart(shift, shortest);
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
