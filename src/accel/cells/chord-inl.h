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
HWY_INLINE Vec3Lanes<D> Scale3(const Vec3Lanes<D>& scale, const Vec3Lanes<D>& v) {
  return {hn::Mul(scale.x, v.x), hn::Mul(scale.y, v.y), hn::Mul(scale.z, v.z)};
}

/// Numbers of one place in as many lists as there are lanes, one by one: gathers are slower on AMD's Zen 4.
template <class D, class ListOf>
HWY_INLINE hn::Vec<D> TakeEach(D d, const ListOf& list_of) {
  HWY_ALIGN double lanes[hn::MaxLanes(D())];
  for (std::size_t lane = 0; lane < hn::MaxLanes(D()); ++lane) lanes[lane] = list_of(lane);
  return hn::Load(d, lanes);
}

/// The numbers of one shape, for all rays.
template <class D, class ShapeType>
class SharedShape {
 public:
  using Shape = ShapeType;

  explicit SharedShape(const Shape& shape) : shape_(shape) {}
  HWY_INLINE hn::Vec<D> Get(double Shape::*number) const { return hn::Set(D(), shape_.*number); }
  template <std::size_t n>
  HWY_INLINE hn::Vec<D> Get(std::array<double, n> Shape::*numbers, std::size_t i) const {
    return hn::Set(D(), (shape_.*numbers)[i]);
  }

 private:
  const Shape& shape_;
};

/// Those of a shape a lane, all of one kind.
template <class D, class ShapeType>
class LaneShapes {
 public:
  using Shape = ShapeType;

  void Put(std::size_t lane, const Shape& shape) { shapes_[lane] = &shape; }
  HWY_INLINE hn::Vec<D> Get(double Shape::*number) const {
    return TakeEach(D(), [&](std::size_t lane) { return shapes_[lane]->*number; });
  }
  template <std::size_t n>
  HWY_INLINE hn::Vec<D> Get(std::array<double, n> Shape::*numbers, std::size_t i) const {
    return TakeEach(D(), [&](std::size_t lane) { return (shapes_[lane]->*numbers)[i]; });
  }

 private:
  std::array<const Shape*, hn::MaxLanes(D())> shapes_;
};

template <class D, class Lanes, std::size_t n>
HWY_INLINE Vec3Lanes<D> Get3(D, const Lanes& shape, std::array<double, n> Lanes::Shape::*numbers, std::size_t i = 0) {
  return {shape.Get(numbers, i), shape.Get(numbers, i + 1), shape.Get(numbers, i + 2)};
}

/// A ray in a shape's frame; t on the world's ray is shift + t here (Placement::to_local).
template <class D>
struct LocalLanes {
  Vec3Lanes<D> origin, direction;
  hn::Vec<D> shift;
};

template <class D, class Lanes>
HWY_INLINE LocalLanes<D> ToLocal(D d, const RayLanes<D>& ray, const Lanes& shape, const Vec3Lanes<D>& center,
                                 const Vec3Lanes<D>& origin, bool from_surface) {
  using Shape = typename Lanes::Shape;
  LocalLanes<D> local;
  const Vec3Lanes<D> from_origin = Sub3(ray.origin, origin);
  local.shift = hn::Zero(d);
  if (!from_surface) local.shift = hn::Mul(Dot(Sub3(center, ray.origin), ray.direction), ray.inverse);
  const Vec3Lanes<D> v = MulAdd(local.shift, ray.direction, from_origin);
  if constexpr (requires { &Shape::scale; }) {
    const auto scale = Get3(d, shape, &Shape::scale);
    local.origin = Scale3(scale, v);
    local.direction = Scale3(scale, ray.direction);
  } else {
    const Vec3Lanes<D> rows[3] = {Get3(d, shape, &Shape::map), Get3(d, shape, &Shape::map, 3),
                                  Get3(d, shape, &Shape::map, 6)};
    local.origin = {Dot(rows[0], v), Dot(rows[1], v), Dot(rows[2], v)};
    local.direction = {Dot(rows[0], ray.direction), Dot(rows[1], ray.direction), Dot(rows[2], ray.direction)};
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
template <class D, class Lanes>
HWY_INLINE ChordLanes<D> SphereChord(D d, const RayLanes<D>& ray, const Lanes& shape, int on_face) {
  using Shape = typename Lanes::Shape;
  const auto center = Get3(d, shape, &Shape::center);
  const LocalLanes<D> local = ToLocal(d, ray, shape, center, center, on_face >= 0);
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
    const auto c = hn::Sub(Dot(p, p), shape.Get(&Shape::square));
    const RootLanes<D> roots =
        SolveQuadratic(d, a, Dot(p, local.direction), c, hn::Mul(shape.Get(&Shape::graze), ray.square));
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
HWY_INLINE void ClipSlab(D d, hn::Vec<D> origin, hn::Vec<D> direction, hn::Vec<D> low, hn::Vec<D> high, double low_face,
                         double high_face, hn::Vec<D> least_slope, hn::Vec<D> near_plane, int on_face,
                         ChordLanes<D>& chord) {
  const auto zero = hn::Zero(d);
  const auto above = hn::Sub(high, origin), below = hn::Sub(low, origin);
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
  chord.hit = hn::And(chord.hit, hn::Or(steep, hn::Gt(depth, zero)));
  chord.unsure = hn::Or(chord.unsure, hn::And(hn::Not(steep), hn::Not(hn::Gt(hn::Abs(depth), near_plane))));
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

template <class D, class Lanes>
HWY_INLINE ChordLanes<D> BoxChord(D d, const RayLanes<D>& ray, const Lanes& shape, int on_face, double reach,
                                  hn::Vec<D> length) {
  using Shape = typename Lanes::Shape;
  const LocalLanes<D> local =
      ToLocal(d, ray, shape, Get3(d, shape, &Shape::center), Get3(d, shape, &Shape::origin), on_face >= 0);
  ChordLanes<D> chord = WholeLine(d);
  const hn::Vec<D> origin[3] = {local.origin.x, local.origin.y, local.origin.z};
  const hn::Vec<D> direction[3] = {local.direction.x, local.direction.y, local.direction.z};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const auto slope = shape.Get(&Shape::least_slope, i);
    ClipSlab(d, origin[i], direction[i], shape.Get(&Shape::low, i), shape.Get(&Shape::high, i), 2 * axis, 2 * axis + 1,
             hn::Mul(slope, length), hn::Mul(hn::Set(d, 16 * reach), slope), on_face, chord);
  }
  ShiftChord<D>(local.shift, chord);
  FinishChord(d, ray, chord);
  return chord;
}

template <class D, class Lanes>
HWY_INLINE ChordLanes<D> CylinderChord(D d, const RayLanes<D>& ray, const Lanes& shape, int on_face, double reach,
                                       hn::Vec<D> length) {
  using Shape = typename Lanes::Shape;
  enum Face { side, bottom, top };
  const LocalLanes<D> local =
      ToLocal(d, ray, shape, Get3(d, shape, &Shape::center), Get3(d, shape, &Shape::origin), on_face >= 0);
  ChordLanes<D> chord = WholeLine(d);
  const auto slope = shape.Get(&Shape::least_slope);
  const auto low = shape.Get(&Shape::low), high = shape.Get(&Shape::high);
  ClipSlab(d, local.origin.z, local.direction.z, low, high, bottom, top, hn::Mul(slope, length),
           hn::Mul(hn::Set(d, 16 * reach), slope), on_face, chord);

  const auto zero = hn::Zero(d);
  const Vec3Lanes<D> o{local.origin.x, local.origin.y, zero}, v{local.direction.x, local.direction.y, zero};
  const auto quadratic = Dot(v, v);
  const auto slanted = hn::Gt(quadratic, hn::Mul(shape.Get(&Shape::parallel), ray.square));
  const auto a = hn::IfThenElse(slanted, quadratic, hn::Set(d, 1.0));
  RootLanes<D> roots;
  auto nearest = zero;
  if (on_face == side) {
    roots = SolveFromSurface(d, a, Dot(o, v));
    const auto certain = hn::Gt(quadratic, hn::Mul(shape.Get(&Shape::start), ray.square));
    roots.unsure = hn::Or(roots.unsure, hn::Not(hn::And(slanted, certain)));
  } else {
    nearest = hn::Div(hn::Neg(Dot(o, v)), a);
    const auto p = MulAdd(nearest, v, o);
    const auto c = hn::Sub(Dot(p, p), shape.Get(&Shape::square));
    roots = SolveQuadratic(d, a, Dot(p, v), c, hn::Mul(shape.Get(&Shape::graze), ray.square));
    // Parallel to the axis, as far as the caps: the whole line is on one side.
    const auto across = Dot(o, o);
    const auto inside = hn::Lt(across, shape.Get(&Shape::surely_inside));
    const auto outside = hn::Gt(across, shape.Get(&Shape::surely_outside));
    const auto height = hn::Sub(high, low);
    const auto middle = hn::Mul(hn::Set(d, 0.5), hn::Add(low, high));
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

/// The chord of any shape that has one.
/// @param take    called with a list of shapes of one kind: that shape, or those, of it
/// @param length  of the rays' directions
template <class D, class Take>
HWY_INLINE ChordLanes<D> FindChord(D d, const RayLanes<D>& ray, const PlacedShapes& shapes, ShapeKind kind,
                                   const Take& take, int on_face, double reach, hn::Vec<D> length) {
  switch (kind) {
    case ShapeKind::upright_sphere:
      return SphereChord(d, ray, take(shapes.upright_spheres), on_face);
    case ShapeKind::sphere:
      return SphereChord(d, ray, take(shapes.spheres), on_face);
    case ShapeKind::upright_box:
      return BoxChord(d, ray, take(shapes.upright_boxes), on_face, reach, length);
    case ShapeKind::box:
      return BoxChord(d, ray, take(shapes.boxes), on_face, reach, length);
    case ShapeKind::cylinder:
      return CylinderChord(d, ray, take(shapes.cylinders), on_face, reach, length);
    case ShapeKind::torus:
    case ShapeKind::general:
      break;
  }
  ChordLanes<D> unknown = WholeLine(d);
  unknown.unsure = unknown.hit;
  return unknown;
}

template <class D>
HWY_INLINE ChordLanes<D> FindChord(D d, const RayLanes<D>& ray, const PlacedShapes& shapes, ShapeRef shape, int on_face,
                                   double reach, hn::Vec<D> length) {
  const auto take = [&]<class Shape>(const std::vector<Shape>& list) {
    return SharedShape<D, Shape>(list[shape.index()]);
  };
  return FindChord(d, ray, shapes, shape.kind(), take, on_face, reach, length);
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
