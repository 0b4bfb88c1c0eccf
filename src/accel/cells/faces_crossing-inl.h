// Where rays cross faces of convex polyhedra and prisms, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_FACES_CROSSING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_FACES_CROSSING_INL_H_
#undef TENON_ACCEL_CELLS_FACES_CROSSING_INL_H_
#else
#define TENON_ACCEL_CELLS_FACES_CROSSING_INL_H_
#endif

#include <hwy/highway.h>

#include <span>
#include <vector>

#include "accel/cells/crossing-inl.h"
#include "primitive/prism.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Cuts a line with the half-space value + t slope <= 0 (clip_half_space). Where it is nearly parallel to the plane it
/// is inside or outside as a whole, unless it might cross that before the end of the scene.
/// @param least_slope, near_plane, enters  as in ClipSlab
/// @param on_it                            whether the ray starts on this face
template <class D>
HWY_INLINE void ClipHalfSpace(D d, hn::Vec<D> value, hn::Vec<D> slope, double face, bool on_it, hn::Vec<D> least_slope,
                              hn::Vec<D> near_plane, hn::Mask<D> enters, CrossingLanes<D>& end) {
  const auto zero = hn::Zero(d);
  const auto steep = hn::Gt(hn::Abs(slope), least_slope);
  const auto is_end = hn::Not(hn::Xor(enters, hn::Lt(slope, zero)));
  const auto t = on_it ? zero : hn::Div(hn::Neg(value), hn::IfThenElse(steep, slope, hn::Set(d, 1.0)));
  Cut(d, hn::And(steep, is_end), enters, t, hn::Set(d, face), end);
  if (HWY_LIKELY(hn::AllTrue(d, steep))) return;
  end.hit = hn::And(end.hit, hn::Or(steep, hn::Lt(value, zero)));
  end.unsure = hn::Or(end.unsure, hn::AndNot(steep, hn::Not(hn::Gt(hn::Abs(value), near_plane))));
}

/// Those of lanes with shapes of their own are not told.
template <class D, class Lanes>
HWY_INLINE CrossingLanes<D> ConvexCrossing(D d, const RayLanes<D>& ray, std::span<const PlacedPlane> planes,
                                           const Lanes& lanes, int on_face, double reach, hn::Vec<D> length,
                                           hn::Mask<D> enters) {
  using Shape = typename Lanes::Shape;
  CrossingLanes<D> end = EndOfLine(d, enters);
  if constexpr (requires { lanes.shape(); }) {
    const LocalLanes<D> local =
        ToLocal(d, ray, lanes, Get3(d, lanes, &Shape::center), Get3(d, lanes, &Shape::origin), on_face >= 0);
    const Shape& shape = lanes.shape();
    for (std::uint32_t i = 0; i < shape.count; ++i) {
      const PlacedPlane& face = planes[shape.first + i];
      const auto& p = face.plane;
      const Vec3Lanes<D> n{hn::Set(d, p[0]), hn::Set(d, p[1]), hn::Set(d, p[2])};
      const auto value = hn::Sub(Dot(n, local.origin), hn::Set(d, p[3]));
      const auto least = hn::Set(d, face.least_slope);
      ClipHalfSpace(d, value, Dot(n, local.direction), i, on_face == static_cast<int>(i), hn::Mul(least, length),
                    hn::Mul(hn::Set(d, 16 * reach), least), enters, end);
    }
    end.t = hn::Add(end.t, local.shift);
  } else {
    end.unsure = end.hit;
  }
  return end;
}

/// The only crossing of a prism about a place: with a cap, a segment or an arc. Each wall is one where the line crosses
/// it about there; nearer than a margin to the end of a wall, or along one, nobody knows.
template <class D>
class PrismCrossing {
 public:
  using V = hn::Vec<D>;
  using M = hn::Mask<D>;

  /// @param local   the rays in the prism's frame
  /// @param length  of their directions, in the world
  /// @param enters  whether it is a crossing where the ray enters
  /// @param about   where it is looked for, on the ray in the world: known within 2 resolutions
  HWY_INLINE PrismCrossing(const RayLanes<D>& ray, const LocalLanes<D>& local, const PlacedPrism& prism, V length,
                           M enters, V about)
      : ray_(ray),
        local_(local),
        prism_(prism),
        enters_(enters),
        at_(hn::Sub(about, local.shift)),
        near_(hn::Mul(hn::Set(D(), 8.0), ray.resolution)),
        margin_(hn::Set(D(), prism.margin)),
        length_(length),
        x_(hn::MulAdd(at_, local.direction.x, local.origin.x)),
        y_(hn::MulAdd(at_, local.direction.y, local.origin.y)) {}

  /// That on the other side of the solid counts where it is near, too.
  HWY_INLINE void MeetCaps(int on_face, double reach) {
    const D d;
    const auto cut = [&](M which) HWY_ATTR {
      return CutByCaps(d, local_, hn::Set(d, prism_.low), hn::Set(d, prism_.high), Prism::bottom, Prism::top,
                       hn::Set(d, prism_.least_slope), length_, reach, on_face, which);
    };
    end_ = cut(enters_);
    const V other = cut(hn::Not(enters_)).t;
    first_ = hn::IfThenElse(enters_, end_.t, other);
    last_ = hn::IfThenElse(enters_, other, end_.t);
    end_.hit = IsNear(end_.t);
    end_.unsure = hn::Or(end_.unsure, IsNear(other));
  }

  /// The second root of an arc that the ray starts on comes otherwise (solve_deflated).
  HWY_INLINE void MeetWalls(int on_face, const PlacedWall* walls) {
    for (const PlacedWall& wall : std::span(walls, prism_.count)) {
      const M apart = hn::Or(IsBeside(x_, wall.lower.x, wall.upper.x), IsBeside(y_, wall.lower.y, wall.upper.y));
      if (hn::AllTrue(D(), apart)) continue;
      if (wall.bulge == 0) {
        MeetSegment(wall, hn::Not(apart));
      } else if (on_face == static_cast<int>(wall.face) || on_face == static_cast<int>(wall.face + 1)) {
        end_.unsure = hn::Or(end_.unsure, hn::Not(apart));
      } else {
        MeetArc(wall, hn::Not(apart));
      }
    }
  }

  HWY_INLINE CrossingLanes<D> Found() {
    end_.unsure = hn::Or(end_.unsure, hn::Not(end_.hit));
    end_.t = hn::Add(end_.t, local_.shift);
    return end_;
  }

 private:
  struct Relative {
    V x, y;
  };

  M IsNear(V t) const { return hn::Le(hn::Abs(hn::Sub(t, at_)), near_); }
  M IsBeside(V place, double low, double high) const {
    const D d;
    return hn::Or(hn::Lt(place, hn::Sub(hn::Set(d, low), margin_)), hn::Gt(place, hn::Add(hn::Set(d, high), margin_)));
  }
  HWY_INLINE Relative RelativeTo(const Vec2& place) const {
    const D d;
    return {hn::Sub(local_.origin.x, hn::Set(d, place.x)), hn::Sub(local_.origin.y, hn::Set(d, place.y))};
  }
  // Products of a vector of the outline, as Prism::Line has them.
  static HWY_INLINE V DotOf(V ax, V ay, V bx, V by) { return hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)); }
  static HWY_INLINE V CrossOf(V ax, V ay, V bx, V by) { return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx)); }

  // Along the normal (w.y, -w.x), which is as long as the wall.
  HWY_INLINE void MeetSegment(const PlacedWall& wall, M there) {
    const D d;
    const V vx = local_.direction.x, vy = local_.direction.y;
    const V wx = hn::Set(d, wall.chord.x), wy = hn::Set(d, wall.chord.y), minus_wx = hn::Set(d, -wall.chord.x);
    const Relative p = RelativeTo(wall.from);
    const V value = DotOf(wy, minus_wx, p.x, p.y), slope = DotOf(wy, minus_wx, vx, vy);
    const V length = hn::Set(d, wall.length);
    const V least = hn::Mul(length, hn::Mul(hn::Set(d, prism_.least_across), length_));
    const M steep = hn::Gt(hn::Abs(slope), least);
    const V t = hn::Div(hn::Neg(value), hn::IfThenElse(steep, slope, hn::Set(d, 1.0)));
    const V along = hn::Div(DotOf(wx, wy, hn::MulAdd(t, vx, p.x), hn::MulAdd(t, vy, p.y)), length);
    const M within = hn::And(hn::Gt(along, margin_), hn::Lt(along, hn::Sub(length, margin_)));
    const M touches = hn::Le(hn::Abs(hn::MulAdd(at_, slope, value)), hn::Mul(length, margin_));
    end_.unsure = hn::Or(end_.unsure, hn::AndNot(steep, hn::And(there, touches)));
    Take(wall, hn::And(steep, hn::And(there, IsNear(t))), within, t, hn::Gt(slope, hn::Zero(d)));
  }

  // The roots of q, expanded where the line is nearest to the middle of the chord between the caps.
  HWY_INLINE void MeetArc(const PlacedWall& wall, M there) {
    const D d;
    const V vx = local_.direction.x, vy = local_.direction.y;
    const V wx = hn::Set(d, wall.chord.x), wy = hn::Set(d, wall.chord.y);
    const V bulge = hn::Set(d, wall.bulge), flatness = hn::Set(d, wall.flatness);
    const Relative from_middle = RelativeTo(wall.middle), start = RelativeTo(wall.from);
    const V square = DotOf(vx, vy, vx, vy);
    const V nearest = hn::Div(hn::Neg(DotOf(from_middle.x, from_middle.y, vx, vy)), square);
    const V not_before = hn::IfThenElse(hn::Gt(nearest, first_), nearest, first_);
    const V at = hn::IfThenElse(hn::Gt(not_before, last_), last_, not_before);
    const V px = hn::Add(start.x, hn::Mul(at, vx)), py = hn::Add(start.y, hn::Mul(at, vy));
    const V qx = hn::Sub(px, wx), qy = hn::Sub(py, wy);
    const V a = hn::Mul(bulge, square);
    const V turn = hn::Mul(flatness, CrossOf(wx, wy, vx, vy));
    const V sum_b = hn::Add(DotOf(px, py, vx, vy), DotOf(vx, vy, qx, qy));
    const V b = hn::Mul(hn::Set(d, 0.5), hn::Sub(hn::Mul(bulge, sum_b), turn));
    const V c = hn::Sub(hn::Mul(bulge, DotOf(px, py, qx, qy)), hn::Mul(flatness, CrossOf(wx, wy, px, py)));
    const RootsLanes<D> roots = FindRoots(d, a, b, c, hn::Mul(hn::Set(d, wall.graze), ray_.square));
    end_.unsure = hn::Or(end_.unsure, hn::And(roots.unsure, there));
    for (const bool is_first : {true, false}) {
      const V t = hn::Add(is_first ? roots.first : roots.second, at);
      // On the arc's side of the chord, and not so near to where its box ends that its place there is cut off.
      const V x = hn::MulAdd(t, vx, start.x), y = hn::MulAdd(t, vy, start.y);
      const V cross = CrossOf(wx, wy, x, y);
      const V side = hn::Div(wall.bulge > 0 ? hn::Neg(cross) : cross, hn::Set(d, wall.length));
      const M crosses = hn::And(hn::And(roots.real, there), hn::And(IsNear(t), hn::Ge(side, hn::Neg(margin_))));
      const auto is_inner = [&](V place, double low, double high, double from) HWY_ATTR {
        return hn::And(hn::Gt(place, hn::Add(hn::Set(d, low - from), margin_)),
                       hn::Lt(place, hn::Sub(hn::Set(d, high - from), margin_)));
      };
      const M within = hn::And(hn::Gt(side, margin_), hn::And(is_inner(x, wall.lower.x, wall.upper.x, wall.from.x),
                                                              is_inner(y, wall.lower.y, wall.upper.y, wall.from.y)));
      Take(wall, crosses, within, t, is_first == (wall.bulge < 0) ? roots.real : hn::Not(roots.real));
    }
  }

  // @param crosses  where the wall is crossed, about there
  // @param within   and not near to its end
  // @param rises    towards the side that its normal points to
  HWY_INLINE void Take(const PlacedWall& wall, M crosses, M within, V t, M rises) {
    const D d;
    end_.unsure = hn::Or(end_.unsure, hn::And(crosses, hn::Or(end_.hit, hn::Not(within))));
    end_.hit = hn::Or(end_.hit, crosses);
    end_.t = hn::IfThenElse(crosses, t, end_.t);
    const M is_next = hn::Not(hn::Xor(enters_, rises));
    const V face = hn::IfThenElse(is_next, hn::Set(d, wall.face + 1.0), hn::Set(d, wall.face));
    end_.face = hn::IfThenElse(crosses, face, end_.face);
  }

  const RayLanes<D>& ray_;
  const LocalLanes<D>& local_;
  const PlacedPrism& prism_;
  const M enters_;
  const V at_, near_, margin_, length_;
  const V x_, y_;   // the place
  V first_, last_;  // where the line is between the caps
  CrossingLanes<D> end_;
};

/// Those of lanes with shapes of their own are not told.
template <class D, class Lanes>
HWY_INLINE CrossingLanes<D> FindPrismCrossing(D d, const RayLanes<D>& ray, std::span<const PlacedWall> walls,
                                              const Lanes& lanes, int on_face, double reach, hn::Vec<D> length,
                                              hn::Mask<D> enters, hn::Vec<D> about) {
  using Shape = typename Lanes::Shape;
  if constexpr (requires { lanes.shape(); }) {
    const LocalLanes<D> local =
        ToLocal(d, ray, lanes, Get3(d, lanes, &Shape::center), Get3(d, lanes, &Shape::origin), on_face >= 0);
    PrismCrossing<D> crossing(ray, local, lanes.shape(), length, enters, about);
    crossing.MeetCaps(on_face, reach);
    crossing.MeetWalls(on_face, walls.data() + lanes.shape().first);
    return crossing.Found();
  } else {
    CrossingLanes<D> end = EndOfLine(d, enters);
    end.unsure = end.hit;
    return end;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
