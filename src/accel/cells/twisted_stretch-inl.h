// The stretches of twisted records, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_TWISTED_STRETCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_TWISTED_STRETCH_INL_H_
#undef TENON_ACCEL_CELLS_TWISTED_STRETCH_INL_H_
#else
#define TENON_ACCEL_CELLS_TWISTED_STRETCH_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/flat_rays-inl.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/scene_rays-inl.h"
#include "accel/cells/wall_crossings-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Rays through the part of a twisted outline that lies in a cell (TwistedRecord).
///
/// In the plane of the outline a ray is at p = R(a t) w, w its place divided by the scales and a its angular speed:
///
///   p'  = R w' + a J p                       |p'| <= |w'| + |a| |p|
///   p'' = R w'' + 2 a J R w' - a² p          |p''| <= |w''| + 2 |a| |w'| + a² |p|
///
/// with J a quarter turn. What a wall's record says of a place, f = curvature |p|² + normal·p, has by that a second
/// derivative below some bound all along the ray. Where f cannot reach zero there is no crossing; where f' cannot, one
/// at most, which Newton's method finds; and otherwise the ray is halved.
template <class D>
class TwistedWalls {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// @param o, v        the rays in the leaf's frame, o relative to the axis, and along it to the part's middle
  /// @param begin, end  what of them matters
  /// @param lanes       the rays that matter
  HWY_INLINE TwistedWalls(const double* record, const SceneRays<D>& ray, const Vec3Lanes<D>& o, const Vec3Lanes<D>& v,
                          V begin, V end, M lanes)
      : record_(record), crossings_(record, begin, end), ray_(ray), o_(o), v_(v), lanes_(lanes) {
    const D d;
    least_ = hn::Mul(hn::Set(d, record[WallsRecord::least]), ray.length);
    doubt_ = hn::Set(d, record[TwistedRecord::doubt]);
    is_scaled_ = record[TwistedRecord::growth] != 0;
    turning_ = hn::Mul(hn::Set(d, record[TwistedRecord::turn]), v.z);
    FindBounds();
    first_ = At(begin);
    last_ = At(end);
    // No farther from the straight way than the second derivative takes it.
    const V span = hn::Sub(end, begin), away = hn::Mul(hn::Set(d, 0.125), hn::Mul(bend_, hn::Mul(span, span)));
    crossings_.RunBetween({hn::Sub(hn::Min(first_.x, last_.x), away), hn::Sub(hn::Min(first_.y, last_.y), away)},
                          {hn::Add(hn::Max(first_.x, last_.x), away), hn::Add(hn::Max(first_.y, last_.y), away)});
  }

  HWY_INLINE void FindCrossings() {
    for (std::size_t i = 0; i < crossings_.count(); ++i) {
      const double* wall = crossings_.wall(i);
      const M lanes = hn::And(lanes_, crossings_.MayMeet(wall));
      if (hn::AllFalse(D(), lanes)) continue;
      const V twice_curvature = hn::Set(D(), 2 * std::fabs(wall[Wall::curvature]));
      wall_bend_ = hn::MulAdd(hn::Set(D(), wall[TwistedRecord::steepness]), bend_,
                              hn::Mul(twice_curvature, hn::Mul(speed_, speed_)));
      Search(wall, {first_, ValueAt(wall, first_)}, {last_, ValueAt(wall, last_)}, lanes, 0);
    }
  }

  HWY_INLINE Stretch<D> OnlyPart(const Stretch<D>& slab, V shift, V shortest) {
    return crossings_.OnlyPart(slab, shift, shortest, [&](V t) HWY_ATTR {
      const Place p = At(t);
      return typename Crossings::Place{p.x, p.y};
    });
  }

 private:
  using Crossings = WallCrossings<D, TwistedRecord>;
  using Wall = WallsRecord::Wall;

  // Of a ray in the plane of the outline, relative to the place that is known, and how it moves there.
  struct Place {
    V t, x, y, way_x, way_y;
  };
  // f there, and its slope.
  struct Value {
    V f, slope;
  };
  struct End {
    Place place;
    Value value;
  };

  // Of |p'| and |p''|, within the cell.
  HWY_INLINE void FindBounds() {
    const D d;
    const V reach = hn::Set(d, record_[TwistedRecord::reach]), turning = hn::Abs(turning_), two = hn::Set(d, 2.0);
    const V shrink = hn::Set(d, 1 / record_[TwistedRecord::least_scale]);
    const V growing = hn::Mul(hn::Set(d, record_[TwistedRecord::growth]), hn::Abs(v_.z));
    const V across = hn::Sqrt(hn::MulAdd(v_.x, v_.x, hn::Mul(v_.y, v_.y)));
    const V way = hn::Mul(hn::MulAdd(reach, growing, across), shrink);
    speed_ = hn::MulAdd(turning, reach, way);
    // |w''| is at most 2 growing shrink |w'|.
    bend_ =
        hn::MulAdd(hn::Mul(two, way), hn::MulAdd(growing, shrink, turning), hn::Mul(reach, hn::Mul(turning, turning)));
  }

  // By Taylor's series, up to x^13 and x^14: for |x| <= 0.52 they are off by x^15 / 15! and x^16 / 16!, below 2^-54.
  static HWY_INLINE void SineCosine(V x, V& sine, V& cosine) {
    const D d;
    const V s = hn::Mul(x, x);
    V odd = hn::Set(d, 1.0 / 6227020800.0), even = hn::Set(d, -1.0 / 87178291200.0);
    for (const double c : {-1.0 / 39916800, 1.0 / 362880, -1.0 / 5040, 1.0 / 120, -1.0 / 6}) {
      odd = hn::MulAdd(odd, s, hn::Set(d, c));
    }
    for (const double c : {1.0 / 479001600, -1.0 / 3628800, 1.0 / 40320, -1.0 / 720, 1.0 / 24, -0.5}) {
      even = hn::MulAdd(even, s, hn::Set(d, c));
    }
    sine = hn::MulAdd(hn::Mul(odd, s), x, x);
    cosine = hn::MulAdd(even, s, hn::Set(d, 1.0));
  }

  HWY_INLINE Place At(V t) const {
    const D d;
    V x = hn::MulAdd(t, v_.x, o_.x), y = hn::MulAdd(t, v_.y, o_.y), way_x = v_.x, way_y = v_.y;
    const V z = hn::MulAdd(t, v_.z, o_.z);
    if (is_scaled_) {
      Scale(TwistedRecord::scale, TwistedRecord::scale_slope, z, x, way_x);
      Scale(TwistedRecord::scale + 1, TwistedRecord::scale_slope + 1, z, y, way_y);
    }
    V sine, cosine;
    SineCosine(hn::Mul(hn::Set(d, record_[TwistedRecord::turn]), z), sine, cosine);
    const V px = hn::NegMulAdd(sine, y, hn::Mul(cosine, x)), py = hn::MulAdd(sine, x, hn::Mul(cosine, y));
    const V wx = hn::NegMulAdd(sine, way_y, hn::Mul(cosine, way_x));
    const V wy = hn::MulAdd(sine, way_x, hn::Mul(cosine, way_y));
    const double* known = record_ + WallsRecord::known;
    return {t, hn::Sub(px, hn::Set(d, known[0])), hn::Sub(py, hn::Set(d, known[1])), hn::NegMulAdd(turning_, py, wx),
            hn::MulAdd(turning_, px, wy)};
  }
  // Divides one coordinate and its derivative by a scale.
  HWY_INLINE void Scale(std::size_t scale, std::size_t slope, V z, V& x, V& way) const {
    const D d;
    const V grows = hn::Set(d, record_[slope]);
    const V shrink = hn::Div(hn::Set(d, 1.0), hn::MulAdd(grows, z, hn::Set(d, record_[scale])));
    x = hn::Mul(x, shrink);
    way = hn::Mul(shrink, hn::NegMulAdd(hn::Mul(x, grows), v_.z, way));
  }

  static HWY_INLINE V X(const double* wall, const Place& p) { return hn::Add(p.x, hn::Set(D(), wall[Wall::place])); }
  static HWY_INLINE V Y(const double* wall, const Place& p) {
    return hn::Add(p.y, hn::Set(D(), wall[Wall::place + 1]));
  }
  static HWY_INLINE Value ValueAt(const double* wall, const Place& p) {
    const D d;
    const V x = X(wall, p), y = Y(wall, p), curvature = hn::Set(d, wall[Wall::curvature]);
    const V c_x = hn::Mul(curvature, x), c_y = hn::Mul(curvature, y);
    const V half_x = hn::Add(hn::Set(d, wall[Wall::normal]), c_x);
    const V half_y = hn::Add(hn::Set(d, wall[Wall::normal + 1]), c_y);
    return {hn::MulAdd(half_x, x, hn::Mul(half_y, y)),
            hn::MulAdd(hn::Add(half_x, c_x), p.way_x, hn::Mul(hn::Add(half_y, c_y), p.way_y))};
  }

  // Finds where rays cross a wall's line between two places.
  HWY_NOINLINE void Search(const double* wall, const End& low, const End& high, M lanes, int depth) {
    constexpr int deepest = 5;
    const D d;
    const V zero = hn::Zero(d), half = hn::Set(d, 0.5);
    const V span = hn::Sub(high.place.t, low.place.t), change = hn::Mul(half, hn::Mul(wall_bend_, span));
    const M is_passed = hn::Xor(hn::Lt(low.value.f, zero), hn::Lt(high.value.f, zero));
    // Below the chord f dips by an eighth of its second derivative times the square of the span.
    const V least = hn::Min(hn::Abs(low.value.f), hn::Abs(high.value.f));
    const V dip = hn::MulAdd(hn::Mul(hn::Set(d, 0.25), change), span, doubt_);
    const V slope = hn::Abs(hn::Mul(half, hn::Add(low.value.slope, high.value.slope)));
    const M is_steep = hn::Gt(slope, hn::Add(hn::Add(change, change), least_));
    const M is_clear = hn::AndNot(is_passed, hn::Or(is_steep, hn::Gt(least, dip)));
    const M crosses = hn::And(lanes, hn::And(is_passed, is_steep));
    if (!hn::AllFalse(d, crosses)) Approach(wall, low, high, crosses);
    const M rest = hn::AndNot(hn::Or(is_clear, crosses), lanes);
    if (hn::AllFalse(d, rest)) return;
    if (depth == deepest) {
      crossings_.Doubt(rest);
      return;
    }
    End middle;
    middle.place = At(hn::MulAdd(half, span, low.place.t));
    middle.value = ValueAt(wall, middle.place);
    Search(wall, low, middle, rest, depth + 1);
    Search(wall, middle, high, rest, depth + 1);
  }

  /// Goes to where a ray crosses a wall's line between two places. From where the chord does, which is within a quarter
  /// of the span, each step leaves at most the square of that share: the slope is at least twice what changes there.
  HWY_INLINE void Approach(const double* wall, const End& low, const End& high, M lanes) {
    const D d;
    const V small = hn::Mul(hn::Set(d, 0x1p-12), ray_.near), span = hn::Sub(high.place.t, low.place.t);
    const V share = hn::Div(low.value.f, hn::Sub(low.value.f, high.value.f));
    Place at = At(hn::MulAdd(share, span, low.place.t));
    Value value = ValueAt(wall, at);
    M moves = lanes;
    for (int round = 0; round < 8 && !hn::AllFalse(d, moves); ++round) {
      const V step = hn::Neg(hn::Mul(value.f, Slowness(d, value.slope)));
      moves = hn::And(moves, hn::Gt(hn::Abs(step), small));
      at = At(hn::Min(hn::Max(hn::Add(at.t, step), low.place.t), high.place.t));
      value = ValueAt(wall, at);
    }
    // Its slope is large against errors, and changes little within them.
    const V least = hn::Max(least_, hn::Mul(wall_bend_, ray_.near));
    crossings_.Doubt(hn::And(lanes, hn::Or(moves, hn::Le(hn::Abs(value.slope), least))));
    crossings_.Take(wall, at.t, lanes, X(wall, at), Y(wall, at), hn::Set(d, 1.0));
  }

  const double* record_;
  Crossings crossings_;
  const SceneRays<D>& ray_;
  const Vec3Lanes<D>&o_, &v_;
  const M lanes_;
  bool is_scaled_;
  V least_, doubt_;
  V turning_;       // how fast the plane turns along the ray
  V speed_, bend_;  // of places
  V wall_bend_;     // of what the wall's record says of them
  Place first_, last_;
};

/// The only part of a twisted outline that a ray meets from t_in to t_out. Where it meets two, or crosses more than two
/// walls, it is not sure. Not a part of its callers: that would slow down what they do in cells of other kinds.
template <class D>
HWY_NOINLINE Stretch<D> TwistedStretch(D d, const SceneRays<D>& ray, const SharedRecord<D>& r, double reach,
                                       hn::Vec<D> t_in, hn::Vec<D> t_out, hn::Mask<D> lanes) {
  Vec3Lanes<D> place;
  const auto shift = Approach(ray, Sub3(ray.origin, Load3(d, r, WallsRecord::center)), place);
  auto o = Map3(d, r, WallsRecord::map, place);
  const auto v = Map3(d, r, WallsRecord::map, ray.direction), middle = Load3(d, r, TwistedRecord::middle);
  o = {hn::Add(o.x, middle.x), hn::Add(o.y, middle.y), hn::Add(o.z, middle.z)};
  // What is that near to another boundary may be one with it.
  const auto shortest = ShortestStretch(d, ray);
  const auto begin = hn::Sub(hn::Sub(t_in, shift), shortest), end = hn::Add(hn::Sub(t_out, shift), shortest);

  const Stretch<D> slab = BetweenCaps(d, o.z, v.z, ray.length, r[TwistedRecord::low], r[TwistedRecord::high],
                                      r[TwistedRecord::least_to_caps], reach);
  TwistedWalls<D> walls(r.values, ray, o, v, begin, end, lanes);
  walls.FindCrossings();
  return walls.OnlyPart(slab, shift, shortest);
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
