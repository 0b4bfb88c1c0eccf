// Where rays cross placed shapes, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_CROSSING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_CROSSING_INL_H_
#undef TENON_ACCEL_CELLS_CROSSING_INL_H_
#else
#define TENON_ACCEL_CELLS_CROSSING_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/lanes-inl.h"
#include "accel/cells/placed_shape.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

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
  const Shape& shape() const { return shape_; }
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

/// One root of a t² + 2 b t + c, a > 0, as solve_quadratic() has it; certain where the discriminant exceeds `graze`,
/// and the roots have 0 between them.
template <class D>
struct RootLanes {
  hn::Vec<D> t;
  hn::Mask<D> real, unsure;
};
/// @param first  whether it is the lesser one
template <class D>
HWY_INLINE RootLanes<D> SolveQuadratic(D d, hn::Vec<D> a, hn::Vec<D> b, hn::Vec<D> c, hn::Vec<D> graze,
                                       hn::Mask<D> first) {
  RootLanes<D> root;
  const auto zero = hn::Zero(d);
  const auto discriminant = hn::Sub(hn::Mul(b, b), hn::Mul(a, c));
  root.real = hn::Gt(discriminant, graze);
  root.unsure = hn::Not(hn::Or(hn::Lt(discriminant, hn::Neg(graze)), hn::And(root.real, hn::Lt(c, zero))));
  const auto width = hn::Sqrt(hn::Max(discriminant, graze));
  // The roots are sum / a, of the sign of the sum, and c / sum.
  const auto falls = hn::Ge(b, zero);
  const auto sum = hn::IfThenElse(falls, hn::Neg(hn::Add(b, width)), hn::Sub(width, b));
  const auto of_sum = hn::Not(hn::Xor(first, falls));
  root.t = hn::Div(hn::IfThenElse(of_sum, sum, c), hn::IfThenElse(of_sum, a, sum));
  return root;
}

/// Both roots of a t² + 2 b t + c, whatever their signs, as solve_quadratic() has them; certain where the discriminant
/// exceeds `graze`, or is below minus that, and a is not zero.
template <class D>
struct RootsLanes {
  hn::Vec<D> first, second;
  hn::Mask<D> real, unsure;
};
template <class D>
HWY_INLINE RootsLanes<D> FindRoots(D d, hn::Vec<D> a, hn::Vec<D> b, hn::Vec<D> c, hn::Vec<D> graze) {
  RootsLanes<D> roots;
  const auto zero = hn::Zero(d);
  const auto discriminant = hn::Sub(hn::Mul(b, b), hn::Mul(a, c));
  roots.real = hn::Gt(discriminant, graze);
  const auto known = hn::Or(roots.real, hn::Lt(discriminant, hn::Neg(graze)));
  roots.unsure = hn::Or(hn::Eq(a, zero), hn::Not(known));
  const auto width = hn::Sqrt(hn::Max(discriminant, graze));
  const auto sum = hn::IfThenElse(hn::Ge(b, zero), hn::Neg(hn::Add(b, width)), hn::Sub(width, b));
  const auto far = hn::Div(sum, a), near = hn::Div(c, sum);
  roots.first = hn::Min(far, near);
  roots.second = hn::Max(far, near);
  return roots;
}

/// From the surface of a quadric: one root is the start, the other -2 b / a (solve_deflated).
template <class D>
HWY_INLINE RootLanes<D> SolveFromSurface(D d, hn::Vec<D> a, hn::Vec<D> b, hn::Mask<D> first) {
  RootLanes<D> root;
  const auto zero = hn::Zero(d);
  const auto other = hn::Div(hn::Mul(hn::Set(d, -2.0), b), a);
  root.t = hn::IfThenElse(hn::Xor(first, hn::Le(b, zero)), other, zero);
  root.real = hn::Eq(a, a);
  root.unsure = hn::Not(root.real);
  return root;
}

/// Where lines of the world enter or leave a solid: by their only chord, or about a place.
///
/// Where `unsure` is false it is exactly the crossing of spans(), and its bound is at most the resolution, if the line
/// is inside for longer than what grazes; one further off than the whole scene may be given as infinite.
template <class D>
struct CrossingLanes {
  hn::Vec<D> t;
  hn::Vec<D> face;  ///< small whole numbers
  hn::Mask<D> hit, unsure;
};

/// What is known before a line is cut.
template <class D>
HWY_INLINE CrossingLanes<D> EndOfLine(D d, hn::Mask<D> enters) {
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  CrossingLanes<D> end;
  end.t = hn::IfThenElse(enters, hn::Neg(infinity), infinity);
  end.face = hn::Zero(d);
  end.hit = hn::Eq(infinity, infinity);
  end.unsure = hn::Not(end.hit);
  return end;
}

/// The later of two entrances, or the earlier of two exits. @param lanes  those in which there is another
template <class D>
HWY_INLINE void Cut(D, hn::Mask<D> lanes, hn::Mask<D> enters, hn::Vec<D> t, hn::Vec<D> face, CrossingLanes<D>& end) {
  const auto shorter = hn::Or(hn::And(enters, hn::Gt(t, end.t)), hn::AndNot(enters, hn::Lt(t, end.t)));
  const auto cuts = hn::And(lanes, shorter);
  end.t = hn::IfThenElse(cuts, t, end.t);
  end.face = hn::IfThenElse(cuts, face, end.face);
}

/// @param on_face  the face that the ray starts on, or -1; one lane then
template <class D, class Lanes>
HWY_INLINE CrossingLanes<D> SphereCrossing(D d, const RayLanes<D>& ray, const Lanes& shape, int on_face,
                                           hn::Mask<D> enters) {
  using Shape = typename Lanes::Shape;
  const auto center = Get3(d, shape, &Shape::center);
  const LocalLanes<D> local = ToLocal(d, ray, shape, center, center, on_face >= 0);
  const auto a = Dot(local.direction, local.direction);
  CrossingLanes<D> end;
  RootLanes<D> root;
  if (on_face >= 0) {
    root = SolveFromSurface(d, a, Dot(local.origin, local.direction), enters);
    end.t = root.t;
  } else {
    const auto nearest = hn::Div(hn::Neg(Dot(local.origin, local.direction)), a);
    const auto p = MulAdd(nearest, local.direction, local.origin);
    const auto c = hn::Sub(Dot(p, p), shape.Get(&Shape::square));
    root = SolveQuadratic(d, a, Dot(p, local.direction), c, hn::Mul(shape.Get(&Shape::graze), ray.square), enters);
    end.t = hn::Add(hn::Add(root.t, nearest), local.shift);
  }
  end.face = hn::Zero(d);
  end.hit = root.real;
  end.unsure = root.unsure;
  return end;
}

/// Cuts a line with a slab (clip_slab). One that is nearly parallel to it is inside or outside as a whole, unless it
/// might cross a face before the end of the scene.
///
/// @param near_plane  a plane met at less than least_slope and further off than this is met beyond the scene
template <class D>
HWY_INLINE void ClipSlab(D d, hn::Vec<D> origin, hn::Vec<D> direction, hn::Vec<D> low, hn::Vec<D> high, double low_face,
                         double high_face, hn::Vec<D> least_slope, hn::Vec<D> near_plane, int on_face,
                         hn::Mask<D> enters, CrossingLanes<D>& end) {
  const auto zero = hn::Zero(d);
  const auto steep = hn::Gt(hn::Abs(direction), least_slope);
  const auto at_high = hn::Xor(enters, hn::Gt(direction, zero));
  const auto face = hn::IfThenElse(at_high, hn::Set(d, high_face), hn::Set(d, low_face));
  const auto way = hn::Sub(hn::IfThenElse(at_high, high, low), origin);
  if (HWY_LIKELY(hn::AllTrue(d, steep) && on_face != static_cast<int>(high_face) &&
                 on_face != static_cast<int>(low_face))) {
    return Cut(d, steep, enters, hn::Div(way, direction), face, end);
  }
  auto t = hn::Div(way, hn::IfThenElse(steep, direction, hn::Set(d, 1.0)));
  if (on_face == static_cast<int>(high_face)) t = hn::IfThenElse(at_high, zero, t);
  if (on_face == static_cast<int>(low_face)) t = hn::IfThenElse(at_high, t, zero);
  Cut(d, steep, enters, t, face, end);

  // Positive inside.
  const auto depth = hn::Min(hn::Sub(high, origin), hn::Sub(origin, low));
  end.hit = hn::And(end.hit, hn::Or(steep, hn::Gt(depth, zero)));
  end.unsure = hn::Or(end.unsure, hn::AndNot(steep, hn::Not(hn::Gt(hn::Abs(depth), near_plane))));
}

/// A line cut with the slab between two caps.
/// @param least_slope  for a direction of length 1
template <class D>
HWY_INLINE CrossingLanes<D> CutByCaps(D d, const LocalLanes<D>& local, hn::Vec<D> low, hn::Vec<D> high, double low_face,
                                      double high_face, hn::Vec<D> least_slope, hn::Vec<D> length, double reach,
                                      int on_face, hn::Mask<D> enters) {
  CrossingLanes<D> end = EndOfLine(d, enters);
  ClipSlab(d, local.origin.z, local.direction.z, low, high, low_face, high_face, hn::Mul(least_slope, length),
           hn::Mul(hn::Set(d, 16 * reach), least_slope), on_face, enters, end);
  return end;
}

template <class D, class Lanes>
HWY_INLINE CrossingLanes<D> BoxCrossing(D d, const RayLanes<D>& ray, const Lanes& shape, int on_face, double reach,
                                        hn::Vec<D> length, hn::Mask<D> enters) {
  using Shape = typename Lanes::Shape;
  const LocalLanes<D> local =
      ToLocal(d, ray, shape, Get3(d, shape, &Shape::center), Get3(d, shape, &Shape::origin), on_face >= 0);
  CrossingLanes<D> end = EndOfLine(d, enters);
  const hn::Vec<D> origin[3] = {local.origin.x, local.origin.y, local.origin.z};
  const hn::Vec<D> direction[3] = {local.direction.x, local.direction.y, local.direction.z};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const auto slope = shape.Get(&Shape::least_slope, i);
    ClipSlab(d, origin[i], direction[i], shape.Get(&Shape::low, i), shape.Get(&Shape::high, i), 2 * axis, 2 * axis + 1,
             hn::Mul(slope, length), hn::Mul(hn::Set(d, 16 * reach), slope), on_face, enters, end);
  }
  end.t = hn::Add(end.t, local.shift);
  return end;
}

template <class D, class Lanes>
HWY_INLINE CrossingLanes<D> CylinderCrossing(D d, const RayLanes<D>& ray, const Lanes& shape, int on_face, double reach,
                                             hn::Vec<D> length, hn::Mask<D> enters) {
  using Shape = typename Lanes::Shape;
  enum Face { side, bottom, top };
  const LocalLanes<D> local =
      ToLocal(d, ray, shape, Get3(d, shape, &Shape::center), Get3(d, shape, &Shape::origin), on_face >= 0);
  const auto low = shape.Get(&Shape::low), high = shape.Get(&Shape::high);
  CrossingLanes<D> end =
      CutByCaps(d, local, low, high, bottom, top, shape.Get(&Shape::least_slope), length, reach, on_face, enters);

  const auto zero = hn::Zero(d);
  const Vec3Lanes<D> o{local.origin.x, local.origin.y, zero}, v{local.direction.x, local.direction.y, zero};
  const auto quadratic = Dot(v, v);
  const auto slanted = hn::Gt(quadratic, hn::Mul(shape.Get(&Shape::parallel), ray.square));
  const auto a = hn::IfThenElse(slanted, quadratic, hn::Set(d, 1.0));
  RootLanes<D> root;
  auto nearest = zero;
  if (on_face == side) {
    root = SolveFromSurface(d, a, Dot(o, v), enters);
    const auto certain = hn::Gt(quadratic, hn::Mul(shape.Get(&Shape::start), ray.square));
    root.unsure = hn::Or(root.unsure, hn::Not(hn::And(slanted, certain)));
  } else {
    nearest = hn::Div(hn::Neg(Dot(o, v)), a);
    const auto p = MulAdd(nearest, v, o);
    const auto c = hn::Sub(Dot(p, p), shape.Get(&Shape::square));
    root = SolveQuadratic(d, a, Dot(p, v), c, hn::Mul(shape.Get(&Shape::graze), ray.square), enters);
    // Parallel to the axis, as far as the caps: the whole line is on one side.
    const auto across = Dot(o, o);
    const auto inside = hn::Lt(across, shape.Get(&Shape::surely_inside));
    const auto outside = hn::Gt(across, shape.Get(&Shape::surely_outside));
    const auto height = hn::Sub(high, low);
    const auto middle = hn::Mul(hn::Set(d, 0.5), hn::Add(low, high));
    const auto aside = hn::Gt(hn::Abs(hn::Sub(local.origin.z, middle)), hn::Mul(hn::Set(d, 2.0), height));
    const auto whole_unsure = hn::Or(aside, hn::Not(hn::Or(inside, outside)));
    root.unsure = hn::Or(hn::And(slanted, root.unsure), hn::AndNot(slanted, whole_unsure));
    root.real = hn::Or(hn::And(slanted, root.real), hn::AndNot(slanted, inside));
  }
  Cut(d, slanted, enters, hn::Add(root.t, nearest), zero, end);
  end.hit = hn::And(end.hit, root.real);
  end.unsure = hn::Or(end.unsure, root.unsure);
  end.t = hn::Add(end.t, local.shift);
  return end;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
