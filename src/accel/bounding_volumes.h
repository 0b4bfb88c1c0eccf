#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/leaf_slabs.h"
#include "kdtree/ray_box.h"

namespace tenon {

/// The leaves of a hierarchy, as its volumes are made from them.
struct VolumeInput {
  const std::vector<EnclosedLeaf>& leaves;
  const LeafSlabs& slabs;

  Box3 hull_of(std::span<const std::uint32_t> members) const {
    Box3 box;
    for (const std::uint32_t i : members) box = hull(box, leaves[i].box);
    return box;
  }
};

/// A kind of bounding volume (course, "Different kinds of bounding volumes"): an array of them, numbered from 0.
///
///   PreparedRay                   what a ray has worked out once for all volumes
///   prepare(ray)
///   set(index, input, members)    makes volume `index` one around the boxes of these leaves
///   span(prepared, index)         the stretch of the ray, t >= 0, in the volume
template <class V>
concept BoundingVolumes = requires(V& v, const V& built, std::size_t i, const VolumeInput& input,
                                   std::span<const std::uint32_t> members, const Ray& ray) {
  v.set(i, input, members);
  { built.span(built.prepare(ray), i) } -> std::same_as<BoxSpan>;
  { built.bytes() } -> std::same_as<std::size_t>;
};

/// Boxes along the axes.
class BoxVolumes {
 public:
  using PreparedRay = BoxRay;

  BoxVolumes(std::size_t count, const VolumeInput&) : boxes_(count) {}
  void set(std::size_t index, const VolumeInput& input, std::span<const std::uint32_t> members) {
    boxes_[index] = input.hull_of(members);
  }
  PreparedRay prepare(const Ray& ray) const { return BoxRay(ray); }
  BoxSpan span(const PreparedRay& ray, std::size_t index) const { return clip(ray, boxes_[index]); }
  std::size_t bytes() const { return boxes_.size() * sizeof(Box3); }

 private:
  std::vector<Box3> boxes_;
};

/// The stretch of a ray, t >= 0, in the unit sphere.
///
/// The course compares d0² = |P0 - C|² - ((P0 - C)·D)² with r². Far from the sphere that difference of squares has no
/// digits left; the point nearest to the centre is as good as the ray's own coordinates, so d0 is taken from it.
inline BoxSpan clip_unit_sphere(const Vec3& origin, const Vec3& direction) {
  const double squared_length = dot(direction, direction);
  const double nearest = -dot(origin, direction) / squared_length;
  const Vec3 point = origin + nearest * direction;
  const double inside = 1 - dot(point, point);
  if (inside < 0) return {1, 0};
  const double half_chord = std::sqrt(inside / squared_length);
  return {std::max(0.0, nearest - half_chord), nearest + half_chord};
}

/// Ellipsoids along the axes, spheres among them: where the unit sphere goes when it is stretched and moved.
class EllipsoidVolumes {
 public:
  struct PreparedRay {
    Vec3 origin, direction;
    double scale;  // t along the ray = scale * t along this direction
  };

  /// @param round  makes spheres
  EllipsoidVolumes(std::size_t count, bool round) : ellipsoids_(count), round_(round) {}

  /// Around the centre of the leaves' hull, with its proportions (a sphere: with equal ones), as large as the farthest
  /// corner of any leaf's box needs it.
  void set(std::size_t index, const VolumeInput& input, std::span<const std::uint32_t> members) {
    const Box3 box = input.hull_of(members);
    const Vec3 center = box.center();
    Vec3 half = 0.5 * box.size();
    // A very flat ellipsoid would magnify the rounding of a distant ray beyond the margin of the boxes: the margin is
    // 2^-32 of the scene, a coordinate's rounding from 2^16 scenes away 2^-37, so a factor of 2^10 across is too much
    // only where the flat axis counts nothing.
    const double thinnest = max_component(half) * (round_ ? 1 : 0x1p-10);
    half = max(half, {thinnest, thinnest, thinnest});
    double reach = 0;
    for (const std::uint32_t i : members) {
      const Box3& b = input.leaves[i].box;
      const Vec3 corner = max(abs(b.lower - center), abs(b.upper - center));
      reach = std::max(reach, length({corner.x / half.x, corner.y / half.y, corner.z / half.z}));
    }
    const Vec3 axes = reach * half;
    ellipsoids_[index] = {center, {1 / axes.x, 1 / axes.y, 1 / axes.z}};
  }
  // A direction of any length, at one whose square neither overflows nor underflows; a power of 2, so nothing is
  // rounded.
  static PreparedRay prepare(const Ray& ray) {
    const int exponent = std::ilogb(max_component(abs(ray.direction)));
    const double scale = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
    return {ray.origin, ray.direction * scale, scale};
  }
  BoxSpan span(const PreparedRay& ray, std::size_t index) const {
    const Ellipsoid& e = ellipsoids_[index];
    const BoxSpan span = clip_unit_sphere((ray.origin - e.center) * e.inverse_axes, ray.direction * e.inverse_axes);
    return {span.t_in * ray.scale, span.t_out * ray.scale};
  }
  std::size_t bytes() const { return ellipsoids_.size() * sizeof(Ellipsoid); }

 private:
  struct Ellipsoid {
    Vec3 center;
    Vec3 inverse_axes;
  };
  std::vector<Ellipsoid> ellipsoids_;
  bool round_;
};

class SphereVolumes : public EllipsoidVolumes {
 public:
  SphereVolumes(std::size_t count, const VolumeInput&) : EllipsoidVolumes(count, true) {}
};

class StretchedVolumes : public EllipsoidVolumes {
 public:
  StretchedVolumes(std::size_t count, const VolumeInput&) : EllipsoidVolumes(count, false) {}
};

/// Polyhedra whose faces have the same few normals everywhere. What depends on ray and normal alone, α and β, is worked
/// out once for a ray: the plane n·p = d is met at t = α d + β (course, "Intersection test: polyhedron").
class SlabVolumes {
 public:
  struct PreparedRay {
    struct Plane {
      double alpha;  // 1 / n·D; 0 where the ray is parallel to the planes
      double beta;   // -n·P0 / n·D; n·P0 where it is parallel
    };
    Plane planes[most_slab_normals];
  };

  SlabVolumes(std::size_t count, const VolumeInput& input)
      : normals_(slab_normals(input.slabs.normals())), slabs_(count * normals_.size()) {}

  void set(std::size_t index, const VolumeInput& input, std::span<const std::uint32_t> members) {
    for (std::size_t n = 0; n < normals_.size(); ++n) {
      Slab all = input.slabs.at(members.front(), n);
      for (const std::uint32_t i : members) {
        const Slab& slab = input.slabs.at(i, n);
        all = {std::min(all.low, slab.low), std::max(all.high, slab.high)};
      }
      slabs_[index * normals_.size() + n] = all;
    }
  }

  PreparedRay prepare(const Ray& ray) const {
    PreparedRay prepared;
    for (std::size_t n = 0; n < normals_.size(); ++n) {
      const double along = dot(normals_[n], ray.direction), start = dot(normals_[n], ray.origin);
      if (along == 0) {
        prepared.planes[n] = {0, start};
      } else {
        prepared.planes[n] = {1 / along, -start / along};
      }
    }
    return prepared;
  }

  BoxSpan span(const PreparedRay& ray, std::size_t index) const {
    BoxSpan span{0, std::numeric_limits<double>::infinity()};
    const Slab* slab = &slabs_[index * normals_.size()];
    for (std::size_t n = 0; n < normals_.size(); ++n, ++slab) {
      const auto [alpha, beta] = ray.planes[n];
      if (alpha == 0) {
        if (beta < slab->low || beta > slab->high) return {1, 0};
        continue;
      }
      const double a = alpha * slab->low + beta, b = alpha * slab->high + beta;
      span.t_in = std::max(span.t_in, alpha < 0 ? b : a);
      span.t_out = std::min(span.t_out, alpha < 0 ? a : b);
    }
    return span;
  }
  std::size_t bytes() const { return slabs_.size() * sizeof(Slab); }

 private:
  std::span<const Vec3> normals_;
  std::vector<Slab> slabs_;
};

}  // namespace tenon
