// Where rays cross faces of convex polyhedra and prisms, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_FACES_CROSSING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_FACES_CROSSING_INL_H_
#undef TENON_ACCEL_CELLS_FACES_CROSSING_INL_H_
#else
#define TENON_ACCEL_CELLS_FACES_CROSSING_INL_H_
#endif

#include <hwy/highway.h>

#include <vector>

#include "accel/cells/crossing-inl.h"

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
HWY_INLINE CrossingLanes<D> ConvexCrossing(D d, const RayLanes<D>& ray, const std::vector<PlacedPlane>& planes,
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

/// The only crossing of a prism about a place: with a cap, or with a segment.
/// @param about  the place, known within 2 resolutions
template <class D, class Lanes>
HWY_INLINE CrossingLanes<D> PrismCrossing(D d, const RayLanes<D>& ray, const std::vector<PlacedWall>& walls,
                                          const Lanes& lanes, int on_face, double reach, hn::Vec<D> length,
                                          hn::Mask<D> enters, hn::Vec<D> about) {
  using Shape = typename Lanes::Shape;
  CrossingLanes<D> end = EndOfLine(d, enters);
  end.unsure = end.hit;
  if constexpr (requires { lanes.shape(); }) {
    const LocalLanes<D> local =
        ToLocal(d, ray, lanes, Get3(d, lanes, &Shape::center), Get3(d, lanes, &Shape::origin), on_face >= 0);
    const Shape& shape = lanes.shape();
    const Vec3Lanes<D>&o = local.origin, &v = local.direction;
    const auto at = hn::Sub(about, local.shift), near = hn::Mul(hn::Set(d, 8.0), ray.resolution);
    const auto is_near = [&](hn::Vec<D> t) { return hn::Le(hn::Abs(hn::Sub(t, at)), near); };

    // Step 1: caps. That on the other side of the solid counts where it is near, too.
    const auto least = hn::Set(d, shape.least_slope);
    const auto clip = [&](hn::Mask<D> which) {
      CrossingLanes<D> cap = EndOfLine(d, which);
      ClipSlab(d, o.z, v.z, hn::Set(d, shape.low), hn::Set(d, shape.high), 0, 1, hn::Mul(least, length),
               hn::Mul(hn::Set(d, 16 * reach), least), on_face, which, cap);
      return cap;
    };
    const CrossingLanes<D> cap = clip(enters), other = clip(hn::Not(enters));
    auto found = is_near(cap.t);
    auto unsure = hn::Or(cap.unsure, is_near(other.t));
    end.t = cap.t;
    end.face = cap.face;

    // Step 2: walls, each of which may be crossed where its segment is, but for the margin at its ends.
    const auto zero = hn::Zero(d);
    const auto least_across = hn::Mul(hn::Set(d, shape.least_across), length);
    const auto margin = hn::Set(d, shape.margin);
    const auto x = hn::MulAdd(at, v.x, o.x), y = hn::MulAdd(at, v.y, o.y);
    for (std::uint32_t i = 0; i < shape.count; ++i) {
      const PlacedWall& wall = walls[shape.first + i];
      const auto is_beside = [&](hn::Vec<D> place, double low, double high) {
        return hn::Or(hn::Lt(place, hn::Sub(hn::Set(d, low), margin)),
                      hn::Gt(place, hn::Add(hn::Set(d, high), margin)));
      };
      const auto apart = hn::Or(is_beside(x, wall.lower.x, wall.upper.x), is_beside(y, wall.lower.y, wall.upper.y));
      if (hn::AllTrue(d, apart)) continue;
      const auto there = hn::Not(apart);
      if (wall.length == 0) {
        unsure = hn::Or(unsure, there);
        continue;
      }
      // Prism::Line::along: the normal is (w.y, -w.x), and not of length 1.
      const auto wx = hn::Set(d, wall.chord.x), wy = hn::Set(d, wall.chord.y), minus_wx = hn::Set(d, -wall.chord.x);
      const auto px = hn::Sub(o.x, hn::Set(d, wall.from.x)), py = hn::Sub(o.y, hn::Set(d, wall.from.y));
      const auto value = hn::Add(hn::Mul(wy, px), hn::Mul(minus_wx, py));
      const auto slope = hn::Add(hn::Mul(wy, v.x), hn::Mul(minus_wx, v.y));
      const auto wall_length = hn::Set(d, wall.length);
      const auto steep = hn::Gt(hn::Abs(slope), hn::Mul(wall_length, least_across));
      const auto t = hn::Div(hn::Neg(value), hn::IfThenElse(steep, slope, hn::Set(d, 1.0)));
      const auto crosses = hn::And(hn::And(steep, there), is_near(t));
      const auto along =
          hn::Div(hn::MulAdd(wx, hn::MulAdd(t, v.x, px), hn::Mul(wy, hn::MulAdd(t, v.y, py))), wall_length);
      const auto within = hn::And(hn::Gt(along, margin), hn::Lt(along, hn::Sub(wall_length, margin)));
      // Near to the end of a wall, or along one, nobody knows.
      const auto touches = hn::Le(hn::Abs(hn::MulAdd(at, slope, value)), hn::Mul(wall_length, margin));
      const auto runs_along = hn::AndNot(steep, hn::And(there, touches));
      unsure = hn::Or(unsure, hn::Or(hn::And(crosses, hn::Or(found, hn::Not(within))), runs_along));
      found = hn::Or(found, crosses);
      end.t = hn::IfThenElse(crosses, t, end.t);
      const auto rises = hn::Not(hn::Xor(enters, hn::Gt(slope, zero)));
      const auto face = hn::IfThenElse(rises, hn::Set(d, wall.face + 1.0), hn::Set(d, wall.face));
      end.face = hn::IfThenElse(crosses, face, end.face);
    }
    end.t = hn::Add(end.t, local.shift);
    end.hit = found;
    end.unsure = hn::Or(unsure, hn::Not(found));
  }
  return end;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
