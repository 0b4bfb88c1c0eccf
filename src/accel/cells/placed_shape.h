#pragma once

#include <hwy/cache_control.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "accel/cells/cell_scale.h"
#include "csg/csg_tree.h"
#include "math/vec2.h"
#include "tenon/base/huge_pages.h"

namespace tenon::cells {

/// The kinds of leaf whose chord is found without error bounds, by the same operations in the same order as spans(), so
/// that t is the same double. Every other leaf is `general`: spans() itself.
///
/// A torus and a prism have no chord, for their crossings may be more than two; but each of them is found from its
/// neighbourhood. Nor has a revolved quadric along a line that is steeper than its side; there, too, a crossing is.
enum class ShapeKind : std::uint8_t {
  general,
  torus,
  prism,
  sphere,
  upright_sphere,
  box,
  upright_box,
  cylinder,
  revolved,
  convex
};

inline bool has_chord(ShapeKind kind) {
  return kind > ShapeKind::prism;
}
/// Of shapes with lists of faces one at a time is followed.
inline bool has_faces(ShapeKind kind) {
  return kind == ShapeKind::prism || kind == ShapeKind::convex;
}

/// A leaf by kind, and its place in the list of that kind.
struct ShapeRef {
  std::uint32_t bits = 0;

  ShapeRef() = default;
  ShapeRef(ShapeKind kind, std::size_t index)
      : bits(static_cast<std::uint32_t>(kind) << 28 | static_cast<std::uint32_t>(index)) {}
  ShapeKind kind() const { return static_cast<ShapeKind>(bits >> 28); }
  std::uint32_t index() const { return bits & 0xfffffff; }
};

/// A sphere under a map that sends axes to axes.
struct alignas(64) UprightSphere {
  std::array<double, 3> center;  ///< world
  std::array<double, 3> scale;   ///< diagonal of local_from_world
  double square;                 ///< of the radius
  /// The discriminant, over |direction|², below which the bounds of the crossings may exceed the resolution.
  double graze;
};

struct alignas(64) PlacedSphere {
  std::array<double, 3> center;
  std::array<double, 9> map;  ///< local_from_world by rows
  double square;
  double graze;
};

struct alignas(64) UprightBox {
  std::array<double, 3> center;  ///< world: of the box
  std::array<double, 3> origin;  ///< world: of its frame
  std::array<double, 3> scale;
  std::array<double, 3> low, high;
  /// The component of the local direction, over |direction|, below which the bound of a crossing with this pair of
  /// faces may exceed the resolution.
  std::array<double, 3> least_slope;
};

struct alignas(64) PlacedBox {
  std::array<double, 3> center;
  std::array<double, 3> origin;
  std::array<double, 9> map;
  std::array<double, 3> low, high;
  std::array<double, 3> least_slope;
};

struct alignas(64) PlacedCylinder {
  std::array<double, 3> center;
  std::array<double, 3> origin;
  std::array<double, 9> map;
  double low, high, square;
  double graze;
  double least_slope;  ///< of the caps
  /// Lines whose direction across the axis is below this, squared, over |direction|², count as parallel to it ...
  double parallel;
  /// ... and are inside or outside as a whole unless x² + y² lies between these.
  double surely_inside, surely_outside;
  /// A ray that starts on the side is certain of where it meets it again if more than this, squared, over |direction|²,
  /// goes across the axis.
  double start;
};

/// RevolvedQuadric.
struct alignas(64) PlacedRevolved {
  std::array<double, 3> center;
  std::array<double, 3> origin;
  std::array<double, 9> map;
  double offset, slope, linear, constant;
  double low, high;
  double graze;
  double least_slope;  ///< of the caps
  double settled;      ///< x² + y² of a root above which it is settled (RevolvedQuadric::is_settled)
  /// A ray that starts on the side is certain of where it meets it again if a, the coefficient of t², is larger than
  /// this, over |direction|².
  double start;
};

/// A face of a ConvexPolyhedron.
struct PlacedPlane {
  std::array<double, 4> plane;  ///< the normal and d
  double least_slope;
};

struct alignas(64) PlacedConvex {
  std::array<double, 3> center;
  std::array<double, 3> origin;
  std::array<double, 9> map;
  std::uint32_t first, count;  ///< in PlacedShapes::planes
};

/// A wall of a Prism: an OutlineEdge.
struct PlacedWall {
  Vec2 from, chord, middle;  ///< where it begins, its chord, and the middle of that
  double length;             ///< of the chord
  double bulge, flatness;
  double graze;  ///< of an arc
  Vec2 lower, upper;
  std::uint32_t face;  ///< where the line rises towards the side that its normal points to, and leaves; else the next
};

/// One that does not taper, of few walls: segments, and arcs of no more than half a circle.
struct alignas(64) PlacedPrism {
  std::array<double, 3> center;
  std::array<double, 3> origin;
  std::array<double, 9> map;
  double low, high;
  double least_slope;   ///< of the caps
  double least_across;  ///< of a wall, for a normal of length 1
  /// A place that is known by plain arithmetic is off by less than half of this.
  double margin;
  std::uint32_t first, count;  ///< in PlacedShapes::walls
};

struct alignas(64) PlacedTorus {
  std::array<double, 3> center;
  std::array<double, 3> origin;
  std::array<double, 9> map;
  double major, minor;
};

/// The leaves of a scene, ready for many rays.
struct PlacedShapes {
  HugePageVector<ShapeRef> of_leaf;  ///< by LeafId
  HugePageVector<UprightSphere> upright_spheres;
  HugePageVector<PlacedSphere> spheres;
  HugePageVector<UprightBox> upright_boxes;
  HugePageVector<PlacedBox> boxes;
  HugePageVector<PlacedCylinder> cylinders;
  HugePageVector<PlacedRevolved> revolved;
  HugePageVector<PlacedConvex> convex;
  HugePageVector<PlacedPlane> planes;
  HugePageVector<PlacedPrism> prisms;
  HugePageVector<PlacedWall> walls;
  HugePageVector<PlacedTorus> tori;

  /// @param order  as in LeafRecords::of()
  static PlacedShapes of(const CsgTree& tree, const CellScale& scale, std::span<const LeafId> order);
  std::size_t memory_bytes() const;

  /// Has a leaf of a kind that is mostly one of many come to the cache, for a ray that ends there.
  void prefetch(ShapeRef shape) const {
    const auto call = [&](const auto& list) {
      const auto* const first = reinterpret_cast<const std::uint8_t*>(&list[shape.index()]);
      for (std::size_t byte = 0; byte < sizeof(list[0]); byte += 64) hwy::Prefetch(first + byte);
    };
    switch (shape.kind()) {
      case ShapeKind::sphere:
        return call(spheres);
      case ShapeKind::upright_sphere:
        return call(upright_spheres);
      case ShapeKind::box:
        return call(boxes);
      case ShapeKind::upright_box:
        return call(upright_boxes);
      case ShapeKind::cylinder:
        return call(cylinders);
      case ShapeKind::revolved:
        return call(revolved);
      case ShapeKind::torus:
        return call(tori);
      case ShapeKind::general:
      case ShapeKind::prism:
      case ShapeKind::convex:
        break;
    }
  }
};

}  // namespace tenon::cells
