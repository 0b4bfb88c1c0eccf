#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "accel/cells/cell_scale.h"
#include "csg/csg_tree.h"
#include "primitive/revolved_quadric.h"
#include "tenon/math/rounding.h"

namespace tenon::cells {

/// When the bounds of a leaf's crossings are at most CellScale::certain: for rays that start within
/// CellScale::far_origin, and crossings within 4 reach of the point nearest to the leaf's centre (the whole scene lies
/// nearer).
class Certainty {
 public:
  Certainty(const Leaf& leaf, const CellScale& scale) : scale_(scale) {
    const Placement& p = leaf.placement;
    const Placement::RayErrors errors = p.ray_errors(scale.far_origin, scale.added_tolerance, scale.ray_errors);
    origin_ = errors.origin;
    direction_ = errors.direction;
    for (int i = 0; i < 3; ++i) most_ += square(length(p.local_from_world_linear().row(i)));
    most_ = std::sqrt(most_);
    for (int i = 0; i < 3; ++i) least_ += square(length(p.world_from_local().row(i)));
    least_ = 1 / std::sqrt(least_);
    // Places in the frame are at most so far off, and round by as much again.
    const double far = 8 * scale.reach * most_;
    place_ = origin_ + 4 * scale.reach * direction_ + gamma(4) * Vec3{far, far, far};
  }

  /// Bound on the error of a place on the ray, per axis of the leaf's frame.
  const Vec3& place() const { return place_; }
  /// That of the direction of a ray, over its length in the world.
  const Vec3& direction() const { return direction_; }
  /// Norms of local_from_world, at most and at least.
  double most_stretch() const { return most_; }
  double least_stretch() const { return least_; }

  /// A discriminant D of q, known to within `error`, has roots within error / sqrt(D); half of that is left for
  /// the rounding of t. Where D is below minus this there are certainly none: D >= -|a| error has.
  double graze(double error) const { return std::max(square(2 * error / scale_.certain), 2 * square(most_) * error); }

  /// graze() for a solid of revolution, by the bound of RevolvedQuadric::error_at over its window. There |x, y| is at
  /// most 3.4 R and w at most 3.2 R (what is expanded at one end of the window reaches to the other, and a sixteenth
  /// beyond), so that all terms together are at most 22 R², and twice their root 9.4 R; |offset| + |slope z| is at most
  /// 2 R. One end of the window may be twice as far off as the error of place is right for; that error is the origin's,
  /// mostly, which is right for rays from far_origin, and so much more than the direction's. None where the errors are
  /// not small against the solid.
  std::optional<double> graze_of(const RevolvedQuadric& q) const {
    const double R = q.greatest_radius, e = std::hypot(place_.x, place_.y), linear = std::fabs(q.linear) * place_.z;
    const double w = std::fabs(q.slope) * place_.z + gamma(5) * 2 * R;
    if (!(e < R / 0x1p10) || !(w < R / 0x1p10) || !(linear < R * R / 0x1p10)) return std::nullopt;
    const double error = (9.4 * R + e) * e + (9.4 * R + w) * w + linear + gamma(10) * 22 * R * R;
    return (1 + square(q.slope)) * graze(error);
  }

  /// The error of Prism::Line::cross_arc, of an arc of no more than half a circle. It lies within half a chord of the
  /// middle of its chord, so that no place where the line is over its box is further than 0.71 chords from that, nor is
  /// the one where q is expanded. So p_most there is at most 1.42 chords, and |p| 1.21, and away |d| another 1.42: the
  /// terms c_size + away (2 b_size + away a_size) are at most 14 b + 4 k squares of the chord. What the scale errs is
  /// part of the error of place, times no more than 4 chords. The place where a straight prism is expanded lies between
  /// the caps, and so no further off than twice what the error of place is right for.
  /// @param chord  at the largest scale
  /// @param place  bound on the error of a place in the plane of the outline
  static double arc_error(double chord, double bulge, double place) {
    const double b = std::fabs(bulge), k = 0.5 * (1 - b * b);
    return chord * ((8 * b + 2 * k + 4) * place + (gamma(24) * (14 * b + 4 * k) + gamma(2) * 5) * chord);
  }

  /// A plane that is met at slope s is crossed within error / |s|.
  double least_slope(double error) const { return 2 * error / scale_.certain; }

  /// Whether the second root of a ray that starts on a quadric of radius r (solve_deflated) is within half of
  /// it, whatever its direction.
  bool starts_are_certain(double r, double least_quadratic) const {
    const double d = length(direction_), o = length(place_), m = most_;
    const double a_error = 2 * m * d + d * d + gamma(12) * m * m;
    const double b_error = (r + o) * d + m * o + gamma(12) * r * m;
    const double bound =
        (a_error * 2 * (r + o) / std::sqrt(least_quadratic) + 2 * b_error) / (least_quadratic - a_error);
    return least_quadratic > 2 * a_error && bound <= 0.5 * scale_.certain;
  }

  /// The least share of a ray's direction that must lie across a quadric's axis, squared, in its frame, for that.
  double least_certain_start(double r) const {
    double share = 0x1p-60 * square(most_);
    while (share < square(most_) && !starts_are_certain(r, share)) share *= 2;
    return share < square(most_) ? share : std::numeric_limits<double>::infinity();
  }

  /// The same for a solid of revolution (RevolvedQuadric::solve_from_surface): how large a, the coefficient of t², has
  /// to be, over |direction|².
  /// @param r       its greatest radius
  /// @param slope   of its side; of the w(z) of RevolvedQuadric
  /// @param linear  the linear term there
  double least_certain_quadratic(double r, double slope, double linear) const {
    const double d = length(direction_), o = length(place_), m = most_, s = std::fabs(slope), l = std::fabs(linear);
    const double w_error = s * o + gamma(5) * 2 * r;
    const double a_error = (2 + s * s) * (2 * m + d) * d + gamma(12) * (1 + s * s) * m * m;
    const double b_error = 2 * (r + o) * d + 2 * m * o + (r + w_error) * s * d + s * m * w_error + 0.5 * l * d +
                           gamma(10) * (2 * r + s * r + l) * m;
    // On the side |x|, |y| and w are at most r, and |offset| + |slope z| at most 2 r.
    return least_certain_deflated(a_error, b_error);
  }

  /// How large a has to be, for a direction of length 1, so that the other root of a t² + 2 b t (solve_deflated) is
  /// within half of it. It lies within the scene, whose points are no further apart than 4 reach, or does not matter.
  double least_certain_deflated(double a_error, double b_error) const {
    return a_error + 2 * (4 * scale_.reach * a_error + 2 * b_error) / scale_.certain;
  }

  static double square(double x) { return x * x; }

 private:
  const CellScale& scale_;
  Vec3 origin_, direction_, place_;
  double most_ = 0, least_ = 0;
};

}  // namespace tenon::cells
