#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "csg/csg_tree.h"
#include "csg/enclosures.h"

namespace tenon::cells {

/// The lengths that `cells` needs of a scene, and how they follow from one another.
///
/// *reach* R: no bounded coordinate is larger.
///
/// *resolution* τ = 2^-27 R: two crossings further apart than 2τ are told apart for certain. Whoever finds the
/// crossings without their error bounds proves that the bounds are at most τ (*certain*; Certainty), or leaves the ray
/// to the exact structure. A crossing's place is off by the scene's tolerance, 2^-42 R, and the rounding of a ray from
/// as far as 2^6 R, about as much; by 1 / slope: so slopes down to 2^-13 are within τ.
///
/// *slack* 2^-20 R: boxes are met in single precision, relative to the scene's centre, at t = plane i - (origin i), i
/// being the inverse of the direction. Coordinates there are at most 2R. Across the plane the rounding of the origin,
/// moved to where the ray meets the scene, amounts to 2^-24 of 2R, that of either product to as much, that of the
/// difference to 2^-24 of 4R, and that of i to as much: 14 · 2^-24 R together, which is less.
///
/// *most_inverse* M: the inverse of a direction is no greater, so that 4 R M is a number in single precision. Of a ray
/// whose direction is longer than 2^30 / M, a plane that is a slack away is then met beyond the scene, as it should be
/// if the ray is parallel to it; shorter ones are left to the exact structure.
///
/// *growth*: cells are classified with their box grown by as much. It covers the slack of the stored box, that of its
/// intersection, and the 8τ on either side within which other crossings matter, with as much again to spare.
///
/// What a part that is stored once (Prototype) takes for the same place is what the scene does: its τ is at least that
/// of the scene, as long as any of its instances makes that in the part's frame, and what is *certain* is at most as
/// long as any makes it.
struct CellScale {
  double reach = 0;
  double resolution = 0;
  double certain = 0;   ///< bound on the bounds of crossings that are found without them
  double together = 0;  ///< faces that are no further apart are certainly one boundary: the scene's tolerance
  /// The errors that rays have in this frame, and what the placement of a leaf adds to that of their origin besides.
  Placement::RayErrors ray_errors;
  double added_tolerance = 0;
  double slack = 0;
  double growth = 0;
  double most_inverse = 0;
  double least_square = 0;  ///< |direction|² of a ray that is not left to the exact structure, as it is if it is ...
  static constexpr double most_square = 0x1p200;  ///< ... greater than this
  double far_origin = 0;  ///< rays that start further off (per coordinate) are left to the exact structure

  /// Of a scene.
  static CellScale of(const CsgTree& tree) {
    CellScale s = of_size(tree);
    s.together = s.added_tolerance = tree.tolerance.distance;
    return s;
  }

  /// What all instances of a part ask of its frame.
  struct Demands {
    double resolution = 0;  ///< at least
    double certain = std::numeric_limits<double>::infinity();
    double together = std::numeric_limits<double>::infinity();
    Placement::RayErrors ray_errors;

    /// Adds those of an instance.
    /// @param around  the scale of the tree that it stands in
    void add(const Placement& instance, const CellScale& around) {
      const Affine3 map = instance.local_from_world_linear();
      // Norms of the map, at most and at least.
      const double most = norm(map), least = 1 / norm(instance.world_from_local());
      resolution = std::max(resolution, around.resolution * most);
      certain = std::min(certain, around.certain * least);
      // An error of a place is stretched by the length of a row, axis by axis, at least.
      for (int i = 0; i < 3; ++i) together = std::min(together, around.together * length(map.row(i)));
      const Placement::RayErrors errors =
          instance.ray_errors(around.far_origin, around.added_tolerance, around.ray_errors);
      ray_errors.origin = max(ray_errors.origin, errors.origin);
      ray_errors.direction = max(ray_errors.direction, errors.direction * (1 / least));
    }

   private:
    static double norm(const Affine3& map) {
      double square = 0;
      for (int i = 0; i < 3; ++i) square += dot(map.row(i), map.row(i));
      return std::sqrt(square);
    }
  };

  /// Of a part in its own frame.
  static CellScale of(const CsgTree& part, const Demands& demands) {
    CellScale s = of_size(part);
    s.set_resolution(std::max(s.resolution, demands.resolution));
    s.certain = std::min(s.resolution, demands.certain);
    s.together = demands.together;
    s.ray_errors = demands.ray_errors;
    return s;
  }

  /// The same along a ray, over what AskedRay::near is.
  double together_to_near() const { return together / (2 * resolution); }

 private:
  static CellScale of_size(const CsgTree& tree) {
    CellScale s;
    for (const Leaf& leaf : tree.leaves) {
      if (leaf.bounds.is_bounded()) s.reach = std::max(s.reach, leaf.bounds.largest_coordinate());
    }
    s.slack = 0x1p-20 * s.reach;
    s.set_resolution(0x1p-27 * s.reach);
    s.most_inverse = std::min(0x1p100, 0x1p120 / s.reach);
    s.least_square = (0x1p30 / s.most_inverse) * (0x1p30 / s.most_inverse);
    s.far_origin = 0x1p6 * s.reach;
    return s;
  }

  void set_resolution(double tau) {
    resolution = certain = tau;
    growth = std::max(4 * slack, 2 * slack + 16 * resolution);
  }
};

}  // namespace tenon::cells
