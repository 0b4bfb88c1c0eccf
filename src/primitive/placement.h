#pragma once

#include <optional>

#include "primitive/local_box.h"
#include "primitive/local_ray.h"
#include "primitive/ray_map.h"
#include "primitive/ray_packet.h"
#include "tenon/math/affine3.h"
#include "tenon/math/box3.h"
#include "tenon/math/ray.h"

namespace tenon {

/// An affine map together with a bound on the error of each entry: what is left of the exact product of the
/// transformations in the scene after rounding.
struct BoundedAffine3 {
  Affine3 map;
  Affine3 error{{{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}};  ///< entry by entry, >= 0
  /// The Euclidean norms of the linear part's error and of the translation's. Entry by entry the bound on a product of
  /// rotations grows with each factor, although a rotation enlarges no error; the norm's does not.
  double linear_error = 0;
  double translation_error = 0;

  /// One transformation as the scene wrote it. Entries of its linear part came from sines, cosines and a few products,
  /// so each is within 16u of the largest in its row; the zeros of a row or column with one other entry (a turn around
  /// a coordinate axis) are exact. A map that sends axes to axes (scaling, mirroring, quarter turns) is exact, and so
  /// is every translation.
  static BoundedAffine3 elementary(const Affine3& map);

  /// Bound on the distance, per axis, between the image of a point under `map` and under the exact map (without the
  /// rounding of applying it), for points with |p| <= extent component by component. Infinite where an error meets an
  /// infinite extent.
  Vec3 point_error(const Vec3& extent) const;
};

/// First `b`, then `a`, errors included.
BoundedAffine3 operator*(const BoundedAffine3& a, const BoundedAffine3& b);

/// How a primitive stands in the world.
class Placement {
 public:
  /// @param world_from_local  where the local frame lies
  /// @param local_center      a point near which the primitive lies in its frame (the centre of its bounds), to which
  ///                          rays are moved before they are mapped
  /// @return nothing when the map flattens space within its own error, or is not finite
  static std::optional<Placement> create(const BoundedAffine3& world_from_local, const Vec3& local_center);

  const Affine3& world_from_local() const { return world_from_local_; }
  /// The linear part of the inverse map; its translation is zero, since points are taken relative to world_origin().
  Affine3 local_from_world_linear() const {
    Affine3 linear;
    for (std::size_t i = 0; i < 3; ++i) {
      linear.m[i] = {map_.rows[i].x, map_.rows[i].y, map_.rows[i].z, 0};
    }
    return linear;
  }
  const Vec3& world_origin() const { return map_.world_origin; }
  /// The point that rays are moved near to.
  const Vec3& world_center() const { return map_.world_center; }
  Vec3 point_to_local(const Vec3& world) const { return to_local_direction(world - world_origin()); }
  /// A normal of the local frame, carried to the world at length 1. A mirrored frame keeps outward normals outward.
  Vec3 normal_to_world(const Vec3& local_normal) const {
    const Vec3 n = map_.rows[0] * local_normal.x + map_.rows[1] * local_normal.y + map_.rows[2] * local_normal.z;
    // As faces of boxes that no map scales have it; to divide by 1 takes as long as by anything.
    return dot(n, n) == 1 ? n : normalize(n);
  }

  struct MappedRay {
    LocalRay ray;
    double shift = 0;  ///< t on the world's ray = shift + t on the local ray; 0 when the ray starts on the primitive
  };
  /// The ray in the local frame. t is unchanged but for the shift (course, "Intersection computation: principle").
  /// @param tolerance  how far apart, in the world, two faces may lie that count as one (the scene's Tolerance); it is
  ///                   added to the error of the origin
  /// @param on_face    the face the ray starts on, or -1
  MappedRay to_local(const Ray& ray, double tolerance, int on_face) const;

  /// The same for a ray of the frame that this placement is in, with the errors that it has already. Where it starts on
  /// the primitive, its on_face says so.
  MappedRay to_local(const LocalRay& ray) const;

  /// The same for rays of the world that are asked together.
  void to_local(const RayPacket& rays, double tolerance, LocalRayPacket& local) const;

  /// Bounds on the errors of a ray: of its origin, and of its direction for one of length 1.
  struct RayErrors {
    Vec3 origin, direction;
  };
  /// Those that to_local() gives a ray, by its length before.
  /// @param farthest  the ray's origin has no larger coordinate
  /// @param before    what it has already
  RayErrors ray_errors(double farthest, double tolerance, const RayErrors& before = {}) const;

  /// The box in the local frame.
  LocalBox to_local(const Box3& box) const;

 private:
  static Vec3 times(const RayMap::Rows& rows, const Vec3& v) {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
  }

  // Bound on the local image of an error.
  Vec3 stretched(const Vec3& error) const;
  Vec3 to_local_direction(const Vec3& v) const { return times(map_.rows, v); }

  Affine3 world_from_local_;
  RayMap map_;
};

}  // namespace tenon
