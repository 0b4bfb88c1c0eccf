#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "primitive/revolution.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// A ray as it runs through the half-plane of the outline: a branch of a hyperbola, its distance from the axis
/// ρ(t) = sqrt(a (t - t_nearest)² + nearest²).
class Revolution::Line {
 public:
  Line(const LocalRay& ray, const OutlineEdges& edges)
      : o_{ray.origin.x, ray.origin.y},
        d_{ray.direction.x, ray.direction.y},
        z_(ray.origin.z),
        z_slope_(ray.direction.z),
        o_error_(length(Vec2{ray.origin_error.x, ray.origin_error.y})),
        d_error_(length(Vec2{ray.direction_error.x, ray.direction_error.y})),
        z_error_(ray.origin_error.z),
        z_slope_error_(ray.direction_error.z),
        on_edge_(ray.on_face < 0 ? -1 : ray.on_face / 2),
        a_(dot(d_, d_)),
        t_nearest_(a_ > 0 ? -dot(o_, d_) / a_ : 0),
        nearest_(length(o_ + t_nearest_ * d_)),
        size_(edges.reach().x + edges.reach().y) {
    if (!std::isfinite(t_nearest_)) t_nearest_ = 0, nearest_ = length(o_);
  }

  /// The part of the line around the whole outline. False when there is none.
  bool find_part(const OutlineEdges& edges) {
    begin_ = -HUGE_VAL;
    end_ = HUGE_VAL;
    // The margin has only to exceed all errors, which grow along the line; where they are not small against the solid
    // nothing can be said anyway.
    pad_ = size_ * 0x1p-4;
    if (!clip_to_box(edges.lower(), edges.upper(), begin_, end_)) return false;
    if (!std::isfinite(begin_) || !std::isfinite(end_)) return false;
    pad_ = error(begin_) + error(end_) + gamma(16) * (size_ + length(o_) + std::fabs(z_));
    return true;
  }
  double begin() const { return begin_; }
  double end() const { return end_; }

  /// Finds where the line may cross edges within a window.
  void cross_edges(const OutlineEdges& edges, const LineWindow& window, std::vector<EdgeCrossing>& out);

  /// Whether the line lies in a straight edge at t, as far as its errors can tell; then inside and outside are both
  /// right, and inside is said.
  bool lies_in_segment(double t) const {
    return std::any_of(in_segments_.begin(), in_segments_.end(), [&](const OutlineEdge* edge) {
      const double at = dot(edge->chord(), this->at(t) - edge->from);
      return at >= 0 && at <= dot(edge->chord(), edge->chord());
    });
  }

  double radius(double t) const { return length(o_ + t * d_); }
  /// In the half-plane.
  Vec2 at(double t) const { return {radius(t), z_ + t * z_slope_}; }
  double speed() const { return std::sqrt(a_ + z_slope_ * z_slope_); }
  /// Bound on the distance between at(t) and the exact place.
  double error(double t) const {
    const double s = std::fabs(t);
    return o_error_ + z_error_ + s * (d_error_ + z_slope_error_) +
           gamma(4) * (length(o_) + std::fabs(z_) + s * (length(d_) + std::fabs(z_slope_)) + size_);
  }

  /// The part of [begin, end] that may be in the ring which a box of the half-plane makes. False when there is none.
  bool clip_to_box(const Vec2& lower, const Vec2& upper, double& begin, double& end) const {
    if (!clip_interval(z_ - upper.y - pad_, z_slope_, begin, end)) return false;
    if (!clip_interval(lower.y - z_ - pad_, -z_slope_, begin, end)) return false;
    const double outer = upper.x + pad_;
    if (nearest_ > outer) return false;
    const double half = a_ > 0 ? std::sqrt((outer - nearest_) * (outer + nearest_) / a_) : HUGE_VAL;
    if (std::isfinite(half)) {
      begin = std::max(begin, t_nearest_ - half);
      end = std::min(end, t_nearest_ + half);
      if (!(begin <= end)) return false;
    }
    if (!std::isfinite(begin) || !std::isfinite(end)) return true;
    return std::max(radius(begin), radius(end)) >= lower.x - pad_;
  }

 private:
  class Profile;
  class DeflatedProfile;
  class RootCollector;

  // How far beyond its box an edge is looked for, so that its crossings are well within.
  double beyond(double begin, double end) const {
    return 0.0625 * (end - begin) + 4 * (error(begin) + error(end)) / speed();
  }
  void cross_edge(std::uint32_t index, const OutlineEdge& edge, const LineWindow& window,
                  std::vector<EdgeCrossing>& out);

  Vec2 o_, d_;
  double z_, z_slope_;
  double o_error_, d_error_, z_error_, z_slope_error_;
  int on_edge_;  // where the ray starts, or -1
  double a_, t_nearest_, nearest_;
  double size_;
  double begin_ = 0, end_ = 0, pad_ = 0;
  std::vector<const OutlineEdge*> in_segments_;
};

}  // namespace tenon
