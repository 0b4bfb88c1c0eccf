// Where rays cross placed shapes of any kind, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_FIND_CROSSING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_FIND_CROSSING_INL_H_
#undef TENON_ACCEL_CELLS_FIND_CROSSING_INL_H_
#else
#define TENON_ACCEL_CELLS_FIND_CROSSING_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/faces_crossing-inl.h"
#include "accel/cells/revolved_crossing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Where rays enter or leave a shape that is neither general nor a torus.
/// @param take    called with a list of shapes of one kind: that shape, or those, of it
/// @param length  of the rays' directions
/// @param enters  which of both is asked
/// @param about   where the crossing is looked for; anything but a number where that is not known
template <class D, class Take>
HWY_INLINE CrossingLanes<D> FindCrossing(D d, const RayLanes<D>& ray, const PlacedShapes& shapes, ShapeKind kind,
                                         const Take& take, int on_face, double reach, hn::Vec<D> length,
                                         hn::Mask<D> enters, hn::Vec<D> about) {
  switch (kind) {
    case ShapeKind::upright_sphere:
      return SphereCrossing(d, ray, take(shapes.upright_spheres), on_face, enters);
    case ShapeKind::sphere:
      return SphereCrossing(d, ray, take(shapes.spheres), on_face, enters);
    case ShapeKind::upright_box:
      return BoxCrossing(d, ray, take(shapes.upright_boxes), on_face, reach, length, enters);
    case ShapeKind::box:
      return BoxCrossing(d, ray, take(shapes.boxes), on_face, reach, length, enters);
    case ShapeKind::cylinder:
      return CylinderCrossing(d, ray, take(shapes.cylinders), on_face, reach, length, enters);
    case ShapeKind::revolved:
      return RevolvedCrossing(d, ray, take(shapes.revolved), on_face, reach, length, enters, about);
    case ShapeKind::convex:
      return ConvexCrossing(d, ray, shapes.planes, take(shapes.convex), on_face, reach, length, enters);
    case ShapeKind::prism:
      return FindPrismCrossing(d, ray, shapes.walls, take(shapes.prisms), on_face, reach, length, enters, about);
    case ShapeKind::torus:
    case ShapeKind::general:
      break;
  }
  CrossingLanes<D> unknown = EndOfLine(d, enters);
  unknown.unsure = unknown.hit;
  return unknown;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
