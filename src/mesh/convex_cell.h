#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tenon/math/vec3.h"
#include "tenon/primitive/primitive_store.h"

namespace tenon {

/// A flat polygon in space.
struct FlatPolygon {
  Plane plane;  ///< with a normal of length 1; from where it points the corners turn to the left
  std::vector<Vec3> corners;

  /// The polygon of some corners, with the plane that fits them (Newell's method); nothing where they have no area.
  static std::optional<FlatPolygon> of(std::vector<Vec3> corners);
};

/// Which part of something lies before a plane, and which behind it: where the normal points is before.
///
/// What is within `same_place` of the plane lies in it.
struct PlaneSide {
  Plane plane;
  double same_place;

  /// How far a point lies before the plane; 0 for one that lies in it.
  double of(const Vec3& p) const;
  PlaneSide reversed() const { return {{-plane.normal, -plane.d}, same_place}; }
  /// What of a convex polygon lies behind the plane or in it: fewer than three corners where that has no area. Where an
  /// edge crosses, the point is the same to the last bit for all polygons that have the edge.
  std::vector<Vec3> behind(std::span<const Vec3> corners) const;
};

/// A convex polyhedron by its faces, which planes can cut.
class ConvexCell {
 public:
  /// The convex hull of points; nothing where that has no volume.
  static std::optional<ConvexCell> around(std::span<const Vec3> points);

  /// Facing outward. Neighbours have the same corners, to the last bit.
  const std::vector<FlatPolygon>& faces() const { return faces_; }
  /// A point within.
  Vec3 middle() const;
  double largest_coordinate() const;

  /// What of it lies behind a plane; nothing where that has no volume.
  std::optional<ConvexCell> behind(const PlaneSide& side) const;

 private:
  explicit ConvexCell(std::vector<FlatPolygon> faces) : faces_(std::move(faces)) {}

  std::vector<FlatPolygon> faces_;
};

/// The disjoint parts of one polyhedron that another leaves of it.
std::vector<ConvexCell> difference(const ConvexCell& a, const ConvexCell& b, double same_place);
/// What two polyhedra have in common; nothing where that has no volume.
std::optional<ConvexCell> intersection(const ConvexCell& a, const ConvexCell& b, double same_place);

}  // namespace tenon
