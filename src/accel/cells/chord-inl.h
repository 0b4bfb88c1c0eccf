// The chords of placed shapes, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_CHORD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_CHORD_INL_H_
#undef TENON_ACCEL_CELLS_CHORD_INL_H_
#else
#define TENON_ACCEL_CELLS_CHORD_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/placed_shape.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class D>
struct Vec3Lanes {
  hn::Vec<D> x, y, z;
};

/// Rays of the world.
template <class D>
struct RayLanes {
  Vec3Lanes<D> origin, direction;
  hn::Vec<D> square;      ///< |direction|²
  hn::Vec<D> inverse;     ///< 1 / square
  hn::Vec<D> resolution;  ///< CellScale::resolution along the ray: divided by |direction|
};

/// The part of a ray's line inside a convex solid.
///
/// Where `unsure` is false the chord is exactly that of spans(), and its bounds are at most the resolution; a crossing
/// further off than the whole scene may be given as infinite.
template <class D>
struct ChordLanes {
  hn::Vec<D> enter, leave;
  hn::Vec<D> enter_face, leave_face;  ///< small whole numbers
  hn::Mask<D> hit, unsure;
};

template <class D>
HWY_INLINE hn::Vec<D> Dot(const Vec3Lanes<D>& a, const Vec3Lanes<D>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
template <class D>
HWY_INLINE Vec3Lanes<D> MulAdd(hn::Vec<D> t, const Vec3Lanes<D>& d, const Vec3Lanes<D>& o) {
  return {hn::Add(o.x, hn::Mul(t, d.x)), hn::Add(o.y, hn::Mul(t, d.y)), hn::Add(o.z, hn::Mul(t, d.z))};
}
template <class D>
HWY_INLINE Vec3Lanes<D> Sub3(const Vec3Lanes<D>& a, const Vec3Lanes<D>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <class D>
HWY_INLINE Vec3Lanes<D> Broadcast(D d, const std::array<double, 3>& v) {
  return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}

template <class D>
HWY_INLINE Vec3Lanes<D> Apply(D, const Vec3Lanes<D>& scale, const Vec3Lanes<D>& v) {
  return {hn::Mul(scale.x, v.x), hn::Mul(scale.y, v.y), hn::Mul(scale.z, v.z)};
}
template <class D>
HWY_INLINE Vec3Lanes<D> Apply(D d, const std::array<double, 9>& m, const Vec3Lanes<D>& v) {
  return {Dot(Vec3Lanes<D>{hn::Set(d, m[0]), hn::Set(d, m[1]), hn::Set(d, m[2])}, v),
          Dot(Vec3Lanes<D>{hn::Set(d, m[3]), hn::Set(d, m[4]), hn::Set(d, m[5])}, v),
          Dot(Vec3Lanes<D>{hn::Set(d, m[6]), hn::Set(d, m[7]), hn::Set(d, m[8])}, v)};
}

/// A ray in a shape's frame; t on the world's ray is shift + t here (Placement::to_local).
template <class D>
struct LocalLanes {
  Vec3Lanes<D> origin, direction;
  hn::Vec<D> shift;
};

template <class D, class Shape>
HWY_INLINE LocalLanes<D> ToLocal(D d, const RayLanes<D>& ray, const Shape& shape, const std::array<double, 3>& center,
                                 const std::array<double, 3>& origin, bool from_surface) {
  LocalLanes<D> local;
  const Vec3Lanes<D> from_origin = Sub3(ray.origin, Broadcast(d, origin));
  local.shift = hn::Zero(d);
  if (!from_surface) {
    const auto to_center = Sub3(Broadcast(d, center), ray.origin);
    local.shift = hn::Mul(Dot(to_center, ray.direction), ray.inverse);
  }
  const Vec3Lanes<D> v = MulAdd(local.shift, ray.direction, from_origin);
  if constexpr (requires { shape.scale; }) {
    const auto scale = Broadcast(d, shape.scale);
    local.origin = Apply(d, scale, v);
    local.direction = Apply(d, scale, ray.direction);
  } else {
    local.origin = Apply(d, shape.map, v);
    local.direction = Apply(d, shape.map, ray.direction);
  }
  return local;
}

/// The roots of a t² + 2 b t + c, a > 0, as solve_quadratic() has them; certain where the discriminant exceeds `graze`.
template <class D>
struct RootLanes {
  hn::Vec<D> first, second;
  hn::Mask<D> real, unsure;
};
template <class D>
HWY_INLINE RootLanes<D> SolveQuadratic(D d, hn::Vec<D> a, hn::Vec<D> b, hn::Vec<D> c, hn::Vec<D> graze) {
  RootLanes<D> roots;
  const auto discriminant = hn::Sub(hn::Mul(b, b), hn::Mul(a, c));
  roots.unsure = hn::Not(hn::Gt(hn::Abs(discriminant), graze));
  roots.real = hn::Gt(discriminant, graze);
  const auto root = hn::Sqrt(hn::Max(discriminant, graze));
  const auto sum = hn::IfThenElse(hn::Ge(b, hn::Zero(d)), hn::Neg(hn::Add(b, root)), hn::Sub(root, b));
  const auto far = hn::Div(sum, a);
  const auto near = hn::Div(c, sum);
  roots.first = hn::Min(far, near);
  roots.second = hn::Max(far, near);
  return roots;
}

/// From the surface of a quadric: one root is the start, the other -2 b / a (solve_deflated).
template <class D>
HWY_INLINE RootLanes<D> SolveFromSurface(D d, hn::Vec<D> a, hn::Vec<D> b) {
  RootLanes<D> roots;
  const auto zero = hn::Zero(d);
  const auto other = hn::Div(hn::Mul(hn::Set(d, -2.0), b), a);
  const auto forward = hn::Le(b, zero);
  roots.first = hn::IfThenElse(forward, zero, other);
  roots.second = hn::IfThenElse(forward, other, zero);
  roots.real = hn::Eq(a, a);
  roots.unsure = hn::Not(roots.real);
  return roots;
}

/// Ends that lie so near to each other that either may come first.
template <class D>
HWY_INLINE void FinishChord(D d, const RayLanes<D>& ray, ChordLanes<D>& chord) {
  const auto width = hn::Sub(chord.leave, chord.enter);
  const auto least = hn::Mul(hn::Set(d, 4.0), ray.resolution);
  chord.unsure = hn::Or(chord.unsure, hn::And(chord.hit, hn::Not(hn::Gt(hn::Abs(width), least))));
  chord.hit = hn::And(chord.hit, hn::Gt(width, hn::Zero(d)));
}

/// @param on_face  the face that the ray starts on, or -1; one lane then
template <class D, class Shape>
HWY_INLINE ChordLanes<D> SphereChord(D d, const RayLanes<D>& ray, const Shape& shape, int on_face) {
  const LocalLanes<D> local = ToLocal(d, ray, shape, shape.center, shape.center, on_face >= 0);
  const auto a = Dot(local.direction, local.direction);
  ChordLanes<D> chord;
  chord.enter_face = chord.leave_face = hn::Zero(d);
  if (on_face >= 0) {
    const RootLanes<D> roots = SolveFromSurface(d, a, Dot(local.origin, local.direction));
    chord.enter = roots.first;
    chord.leave = roots.second;
    chord.hit = roots.real;
    chord.unsure = roots.unsure;
  } else {
    const auto nearest = hn::Div(hn::Neg(Dot(local.origin, local.direction)), a);
    const auto p = MulAdd(nearest, local.direction, local.origin);
    const auto c = hn::Sub(Dot(p, p), hn::Set(d, shape.square));
    const RootLanes<D> roots =
        SolveQuadratic(d, a, Dot(p, local.direction), c, hn::Mul(hn::Set(d, shape.graze), ray.square));
    chord.enter = hn::Add(hn::Add(roots.first, nearest), local.shift);
    chord.leave = hn::Add(hn::Add(roots.second, nearest), local.shift);
    chord.hit = roots.real;
    chord.unsure = roots.unsure;
  }
  FinishChord(d, ray, chord);
  return chord;
}

/// Cuts a chord with a slab (clip_slab). A line that is nearly parallel to it is inside or outside as a whole, unless
/// it might cross a face before the end of the scene.
///
/// @param near_plane  a plane met at less than least_slope and further off than this is met beyond the scene
template <class D>
HWY_INLINE void ClipSlab(D d, hn::Vec<D> origin, hn::Vec<D> direction, double low, double high, double low_face,
                         double high_face, hn::Vec<D> least_slope, double near_plane, int on_face,
                         ChordLanes<D>& chord) {
  const auto zero = hn::Zero(d);
  const auto above = hn::Sub(hn::Set(d, high), origin), below = hn::Sub(hn::Set(d, low), origin);
  const auto steep = hn::Gt(hn::Abs(direction), least_slope);
  const auto slope = hn::IfThenElse(steep, direction, hn::Set(d, 1.0));
  auto t_high = hn::Div(above, slope), t_low = hn::Div(below, slope);
  if (on_face == static_cast<int>(high_face)) t_high = zero;
  if (on_face == static_cast<int>(low_face)) t_low = zero;
  const auto forward = hn::Gt(direction, zero);
  const auto enter = hn::IfThenElse(forward, t_low, t_high), leave = hn::IfThenElse(forward, t_high, t_low);
  const auto first = hn::Set(d, low_face), last = hn::Set(d, high_face);

  const auto later = hn::And(steep, hn::Gt(enter, chord.enter));
  chord.enter = hn::IfThenElse(later, enter, chord.enter);
  chord.enter_face = hn::IfThenElse(later, hn::IfThenElse(forward, first, last), chord.enter_face);
  const auto earlier = hn::And(steep, hn::Lt(leave, chord.leave));
  chord.leave = hn::IfThenElse(earlier, leave, chord.leave);
  chord.leave_face = hn::IfThenElse(earlier, hn::IfThenElse(forward, last, first), chord.leave_face);

  // Positive inside.
  const auto depth = hn::Min(above, hn::Neg(below));
  const auto margin = hn::Set(d, near_plane);
  chord.hit = hn::And(chord.hit, hn::Or(steep, hn::Gt(depth, zero)));
  chord.unsure = hn::Or(chord.unsure, hn::And(hn::Not(steep), hn::Not(hn::Gt(hn::Abs(depth), margin))));
}

template <class D>
HWY_INLINE ChordLanes<D> WholeLine(D d) {
  ChordLanes<D> chord;
  chord.enter = hn::Set(d, -std::numeric_limits<double>::infinity());
  chord.leave = hn::Set(d, std::numeric_limits<double>::infinity());
  chord.enter_face = chord.leave_face = hn::Zero(d);
  chord.hit = hn::Eq(chord.enter_face, chord.enter_face);
  chord.unsure = hn::Not(chord.hit);
  return chord;
}

template <class D>
HWY_INLINE void ShiftChord(hn::Vec<D> shift, ChordLanes<D>& chord) {
  chord.enter = hn::Add(chord.enter, shift);
  chord.leave = hn::Add(chord.leave, shift);
}

template <class D, class Shape>
HWY_INLINE ChordLanes<D> BoxChord(D d, const RayLanes<D>& ray, const Shape& shape, int on_face, double reach,
                                  hn::Vec<D> length) {
  const LocalLanes<D> local = ToLocal(d, ray, shape, shape.center, shape.origin, on_face >= 0);
  ChordLanes<D> chord = WholeLine(d);
  const hn::Vec<D> origin[3] = {local.origin.x, local.origin.y, local.origin.z};
  const hn::Vec<D> direction[3] = {local.direction.x, local.direction.y, local.direction.z};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double slope = shape.least_slope[i];
    ClipSlab(d, origin[i], direction[i], shape.low[i], shape.high[i], 2 * axis, 2 * axis + 1,
             hn::Mul(hn::Set(d, slope), length), 16 * reach * slope, on_face, chord);
  }
  ShiftChord<D>(local.shift, chord);
  FinishChord(d, ray, chord);
  return chord;
}

template <class D>
HWY_INLINE ChordLanes<D> CylinderChord(D d, const RayLanes<D>& ray, const PlacedCylinder& shape, int on_face,
                                       double reach, hn::Vec<D> length) {
  enum Face { side, bottom, top };
  const LocalLanes<D> local = ToLocal(d, ray, shape, shape.center, shape.origin, on_face >= 0);
  ChordLanes<D> chord = WholeLine(d);
  ClipSlab(d, local.origin.z, local.direction.z, shape.low, shape.high, bottom, top,
           hn::Mul(hn::Set(d, shape.least_slope), length), 16 * reach * shape.least_slope, on_face, chord);

  const auto zero = hn::Zero(d);
  const Vec3Lanes<D> o{local.origin.x, local.origin.y, zero}, v{local.direction.x, local.direction.y, zero};
  const auto quadratic = Dot(v, v);
  const auto slanted = hn::Gt(quadratic, hn::Mul(hn::Set(d, shape.parallel), ray.square));
  const auto a = hn::IfThenElse(slanted, quadratic, hn::Set(d, 1.0));
  RootLanes<D> roots;
  auto nearest = zero;
  if (on_face == side) {
    roots = SolveFromSurface(d, a, Dot(o, v));
    const auto certain = hn::Gt(quadratic, hn::Mul(hn::Set(d, shape.start), ray.square));
    roots.unsure = hn::Or(roots.unsure, hn::Not(hn::And(slanted, certain)));
  } else {
    nearest = hn::Div(hn::Neg(Dot(o, v)), a);
    const auto p = MulAdd(nearest, v, o);
    const auto c = hn::Sub(Dot(p, p), hn::Set(d, shape.square));
    roots = SolveQuadratic(d, a, Dot(p, v), c, hn::Mul(hn::Set(d, shape.graze), ray.square));
    // Parallel to the axis, as far as the caps: the whole line is on one side.
    const auto across = Dot(o, o);
    const auto inside = hn::Lt(across, hn::Set(d, shape.surely_inside));
    const auto outside = hn::Gt(across, hn::Set(d, shape.surely_outside));
    const auto height = hn::Set(d, shape.high - shape.low);
    const auto middle = hn::Set(d, 0.5 * (shape.low + shape.high));
    const auto aside = hn::Gt(hn::Abs(hn::Sub(local.origin.z, middle)), hn::Mul(hn::Set(d, 2.0), height));
    const auto whole_unsure = hn::Or(aside, hn::Not(hn::Or(inside, outside)));
    roots.unsure = hn::Or(hn::And(slanted, roots.unsure), hn::AndNot(slanted, whole_unsure));
    roots.real = hn::Or(hn::And(slanted, roots.real), hn::AndNot(slanted, inside));
  }
  const auto first = hn::Add(roots.first, nearest), second = hn::Add(roots.second, nearest);
  const auto later = hn::And(slanted, hn::Gt(first, chord.enter));
  chord.enter = hn::IfThenElse(later, first, chord.enter);
  chord.enter_face = hn::IfThenElse(later, zero, chord.enter_face);
  const auto earlier = hn::And(slanted, hn::Lt(second, chord.leave));
  chord.leave = hn::IfThenElse(earlier, second, chord.leave);
  chord.leave_face = hn::IfThenElse(earlier, zero, chord.leave_face);
  chord.hit = hn::And(chord.hit, roots.real);
  chord.unsure = hn::Or(chord.unsure, roots.unsure);
  ShiftChord<D>(local.shift, chord);
  FinishChord(d, ray, chord);
  return chord;
}

/// The chord of any shape but a general one.
/// @param length  of the rays' directions
template <class D>
HWY_INLINE ChordLanes<D> FindChord(D d, const RayLanes<D>& ray, const PlacedShapes& shapes, ShapeRef shape, int on_face,
                                   double reach, hn::Vec<D> length) {
  switch (shape.kind()) {
    case ShapeKind::upright_sphere:
      return SphereChord(d, ray, shapes.upright_spheres[shape.index()], on_face);
    case ShapeKind::sphere:
      return SphereChord(d, ray, shapes.spheres[shape.index()], on_face);
    case ShapeKind::upright_box:
      return BoxChord(d, ray, shapes.upright_boxes[shape.index()], on_face, reach, length);
    case ShapeKind::box:
      return BoxChord(d, ray, shapes.boxes[shape.index()], on_face, reach, length);
    case ShapeKind::cylinder:
      return CylinderChord(d, ray, shapes.cylinders[shape.index()], on_face, reach, length);
    case ShapeKind::general:
      break;
  }
  ChordLanes<D> unknown = WholeLine(d);
  unknown.unsure = unknown.hit;
  return unknown;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
