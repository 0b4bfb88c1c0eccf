#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "math/quadratic.h"
#include "primitive/prism.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// A ray as it runs through the plane of the outline: at t it is at (o + t d) / (s + t s_slope). Everything is asked
/// relative to a corner v, as the linear function o - v s + t (d - v s_slope), so that nothing is divided.
class Prism::Line {
 public:
  Line(const Prism& prism, const LocalRay& ray)
      : o_{ray.origin.x, ray.origin.y},
        d_{ray.direction.x, ray.direction.y},
        o_error_{ray.origin_error.x, ray.origin_error.y},
        d_error_{ray.direction_error.x, ray.direction_error.y},
        on_edge_(ray.on_face < static_cast<int>(walls) ? -1 : (ray.on_face - static_cast<int>(walls)) / 2) {
    if (prism.scale == 1) return;
    const double k = prism.slope(), rise = ray.origin.z - prism.low();
    s_ = 1 + rise * k;
    s_slope_ = ray.direction.z * k;
    s_error_ = std::fabs(k) * ray.origin_error.z + gamma(6) * (1 + std::fabs(rise * k) + std::fabs(prism.low() * k));
    s_slope_error_ = std::fabs(k) * ray.direction_error.z + gamma(4) * std::fabs(s_slope_);
  }

  /// The part of the line over the outline's box and between the caps. False when there is none.
  bool find_part(const OutlineEdges& edges, const Chord& slab) {
    Chord over;
    const Vec2 lower = edges.lower(), upper = edges.upper();
    if (!clip_half_space(along({1, 0}, {upper.x, 0}), 0, false, over)) return false;
    if (!clip_half_space(along({-1, 0}, {lower.x, 0}), 0, false, over)) return false;
    if (!clip_half_space(along({0, 1}, {0, upper.y}), 0, false, over)) return false;
    if (!clip_half_space(along({0, -1}, {0, lower.y}), 0, false, over)) return false;
    first_ = slab.enter.t;
    last_ = slab.leave.t;
    part_.begin = std::max(over.enter.lo, slab.enter.lo);
    part_.end = std::min(over.leave.hi, slab.leave.hi);
    // Behind the tip everything is mirrored.
    const bool reaches_tip = least_scale() <= 0;
    part_.outside_before = !reaches_tip && over.enter.lo >= slab.enter.lo;
    part_.outside_after = !reaches_tip && over.leave.hi <= slab.leave.hi;
    if (!(part_.begin <= part_.end) || !std::isfinite(part_.begin) || !std::isfinite(part_.end)) return false;

    const double t = farthest();
    const Vec2 m = edges.reach();
    const Vec2 size = abs(o_) + t * abs(d_) + (std::fabs(s_) + t * std::fabs(s_slope_)) * m;
    // Five roundings of a box test, and one of its t, counted twice over.
    pad_ = o_error_ + t * d_error_ + (s_error_ + t * s_slope_error_) * m + gamma(16) * size;
    return true;
  }
  const SearchedPart& part() const { return part_; }

  Vec2 at(double t) const {
    const double s = s_ + t * s_slope_;
    const Vec2 p = o_ + t * d_;
    return {p.x / s, p.y / s};
  }
  bool is_before_tip(double t) const { return s_ + t * s_slope_ > 0; }

  /// How far at(t) in the middle of the part can be from any exact place of it, when the line moves across less than
  /// its own error there; negative when it moves more.
  double blur() const {
    const double a = part_.begin, b = part_.end, middle = 0.5 * a + 0.5 * b;
    const double s = s_ + middle * s_slope_;
    if (!(s > 0) || !is_before_tip(a) || !is_before_tip(b)) return -1;
    const double s_least = std::min(s_ + a * s_slope_, s_ + b * s_slope_);
    const double drift = length(at(b) - at(a));
    const double slip = length(pad_) / s_least;
    return drift <= slip ? drift + slip : -1;
  }

  /// The part of the line that may be over a box of the plane. False when there is none.
  bool clip_to_box(const Vec2& lower, const Vec2& upper, double& begin, double& end) const {
    begin = part_.begin;
    end = part_.end;
    return clip_interval(o_.x - upper.x * s_ - pad_.x, d_.x - upper.x * s_slope_, begin, end) &&
           clip_interval(lower.x * s_ - o_.x - pad_.x, lower.x * s_slope_ - d_.x, begin, end) &&
           clip_interval(o_.y - upper.y * s_ - pad_.y, d_.y - upper.y * s_slope_, begin, end) &&
           clip_interval(lower.y * s_ - o_.y - pad_.y, lower.y * s_slope_ - d_.y, begin, end);
  }

  /// Finds where the line may cross edges within a window.
  void cross_edges(const OutlineEdges& edges, const LineWindow& window, std::vector<EdgeCrossing>& out) {
    out.clear();
    double begin = 0, end = 0;
    edges.visit_edges(
        [&](const Vec2& lower, const Vec2& upper) {
          return clip_to_box(lower, upper, begin, end) && window.meets(begin, end);
        },
        [&](std::uint32_t i) {
          cross_edge(i, edges.edges()[i], out);
          return true;
        });
    std::erase_if(out, [&](const EdgeCrossing& c) { return !window.meets(c.lo, c.hi); });
  }

  /// Whether the line lies in a segment at t, as far as its errors can tell; then inside and outside are both right,
  /// and inside is said.
  bool lies_in_segment(double t) const {
    return std::any_of(in_segments_.begin(), in_segments_.end(),
                       [t](const auto& in) { return in.first <= t && t <= in.second; });
  }

 private:
  void cross_edge(std::uint32_t index, const OutlineEdge& edge, std::vector<EdgeCrossing>& out) {
    double begin, end;
    if (!clip_to_box(edge.lower, edge.upper, begin, end)) return;
    if (edge.is_arc()) {
      cross_arc(index, edge, begin, end, out);
    } else {
      cross_segment(index, edge, begin, end, out);
    }
  }
  // The line relative to a corner.
  struct Relative {
    Vec2 p, d;
    Vec2 p_error, d_error;
  };
  Relative relative_to(const Vec2& v) const {
    const Vec2 p = o_ - s_ * v, d = d_ - s_slope_ * v;
    const Vec2 m = abs(v);
    // A product and a difference; straight prisms have no product to round.
    return {p, d, o_error_ + s_error_ * m + gamma(1) * abs(p) + (s_slope_ == 0 ? 0 : gamma(1) * std::fabs(s_)) * m,
            d_error_ + s_slope_error_ * m + gamma(1) * abs(d) + gamma(1) * std::fabs(s_slope_) * m};
  }
  // n·(p - v s): a plane through a corner.
  BoundedLine along(const Vec2& n, const Vec2& v) const {
    const Relative r = relative_to(v);
    const Vec2 m = abs(n);
    return {dot(n, r.p), dot(n, r.d), dot(m, r.p_error) + gamma(4) * dot(m, abs(r.p)),
            dot(m, r.d_error) + gamma(4) * dot(m, abs(r.d))};
  }
  // Where the line of a straight prism is nearest to a place between the caps, which does not depend on error bounds;
  // `other` where that is not known.
  double nearest_to(const Vec2& v, double other) const {
    const Relative r = relative_to(v);
    const double nearest = -dot(r.p, r.d) / dot(r.d, r.d);
    const double not_before = nearest > first_ ? nearest : first_;
    const double at = not_before > last_ ? last_ : not_before;
    return std::isfinite(at) ? at : other;
  }
  // On which side of the line a corner lies: positive to the left of its direction.
  struct Side {
    double value, error;
    bool is_sure() const { return std::fabs(value) > error; }
  };
  Side side_of(const Vec2& v) const {
    const Relative r = relative_to(v);
    const Vec2 p = abs(r.p), d = abs(r.d);
    const Vec2 pe = r.p_error, de = r.d_error;
    const double error = (p.x + pe.x) * de.y + pe.x * d.y + (p.y + pe.y) * de.x + pe.y * d.x;
    return {cross(r.p, r.d), error * (1 + gamma(8)) + gamma(4) * (p.x * d.y + p.y * d.x)};
  }

  double farthest() const { return std::max(std::fabs(part_.begin), std::fabs(part_.end)); }
  double least_scale() const {
    if (s_slope_ == 0 && s_slope_error_ == 0) return s_ - s_error_;
    const auto least = [this](double t) { return s_ + t * s_slope_ - s_error_ - std::fabs(t) * s_slope_error_; };
    return std::min(least(part_.begin), least(part_.end));
  }

  void add(EdgeCrossing crossing, double begin, double end, std::vector<EdgeCrossing>& out) const {
    crossing.lo = std::max(crossing.lo, begin);
    crossing.hi = std::min(crossing.hi, end);
    if (!(crossing.lo <= crossing.hi)) return;
    crossing.t = std::clamp(crossing.t, crossing.lo, crossing.hi);
    if (std::isfinite(crossing.t)) out.push_back(crossing);
  }

  void cross_segment(std::uint32_t index, const OutlineEdge& edge, double begin, double end,
                     std::vector<EdgeCrossing>& out) {
    const Side a = side_of(edge.from), b = side_of(edge.to);
    const bool a_sure = a.is_sure(), b_sure = b.is_sure();
    if (a_sure && b_sure && (a.value < 0) == (b.value < 0)) return;
    const Vec2 w = edge.chord();
    const BoundedLine f = along({w.y, -w.x}, edge.from);
    EdgeCrossing crossing{{0.5 * begin + 0.5 * end, begin, end}, index, f.slope > 0, a_sure && b_sure, false};
    if (std::fabs(f.slope) > f.slope_error) {
      const End at = plane_end(f, 0, false);
      if (on_edge_ == static_cast<int>(index)) {
        const double doubt = std::max({0.0, -at.lo, at.hi});
        out.push_back(EdgeCrossing::at_start(index, f.slope > 0, doubt, begin, end));
        return;
      }
      crossing.t = at.t;
      crossing.lo = at.lo;
      crossing.hi = at.hi;
    } else {
      // All but parallel: it meets the wall's plane where it is over the edge, or not at all.
      const double t = 0.5 * begin + 0.5 * end, half = 0.5 * (end - begin);
      const double away = std::fabs(f.value + t * f.slope);
      const double reach = f.value_error + (std::fabs(t) + half) * f.slope_error + half * std::fabs(f.slope);
      if (away > reach + gamma(4) * (std::fabs(f.value) + std::fabs(t * f.slope))) return;
      if (!a_sure && !b_sure) {
        in_segments_.emplace_back(begin, end);
        return;
      }
    }
    add(crossing, begin, end, out);
  }

  void cross_arc(std::uint32_t index, const OutlineEdge& edge, double begin, double end,
                 std::vector<EdgeCrossing>& out) const {
    const bool given = on_edge_ == static_cast<int>(index);
    // q along the line, expanded at `at`.
    const double middle = 0.5 * begin + 0.5 * end;
    const double at = given ? 0 : s_slope_ == 0 ? nearest_to(edge.middle_of_chord(), middle) : middle;
    const Vec2 w = edge.chord();
    const double bulge = edge.bulge, k = edge.flatness();
    const Relative r = relative_to(edge.from);
    const Vec2 p = r.p + at * r.d, d = r.d;
    const double s = s_ + at * s_slope_;
    const Vec2 p2 = p - s * w, d2 = d - s_slope_ * w;
    const double a = bulge * dot(d, d2) - k * cross(w, d) * s_slope_;
    const double b = 0.5 * (bulge * (dot(p, d2) + dot(d, p2)) - k * (cross(w, p) * s_slope_ + cross(w, d) * s));
    const double c = bulge * dot(p, p2) - k * cross(w, p) * s;

    // What the terms are before they cancel, and the errors of what they are made of, by their lengths.
    const double ab = std::fabs(bulge), ak = std::fabs(k), lw = length(w);
    const double lp = length(p), ld = length(d), ls = std::fabs(s), ls_slope = std::fabs(s_slope_);
    const double a_size = ab * ld * (ld + ls_slope * lw) + ak * lw * ld * ls_slope;
    const double b_size =
        ab * ld * (2 * lp + (ls + ls_slope) * lw) + ak * lw * (lp * ls_slope + ld * ls) + ab * lp * ls_slope * lw;
    const double c_size = ab * lp * (lp + ls * lw) + ak * lw * lp * ls;
    const double away = given ? 0 : std::max(std::fabs(begin - at), std::fabs(end - at)) + gamma(4) * farthest();
    const double reach = std::fabs(at) + away;
    const double place = length(r.p_error + reach * r.d_error) + gamma(2) * (lp + std::fabs(at) * ld);
    const double scale_error = s_error_ + reach * s_slope_error_ + gamma(2) * (ls + std::fabs(at) * ls_slope);
    // The line is furthest from a place at one of its ends.
    const double furthest =
        given ? lp : std::max(length(r.p + begin * r.d), length(r.p + end * r.d)) + gamma(8) * (lp + farthest() * ld);
    const double p_most = furthest + place, s_most = ls + away * ls_slope + scale_error;

    const double by_place = (ab * (2 * p_most + lw * s_most) + ak * lw * s_most) * place;
    const double by_scale = (ab + ak) * lw * p_most * scale_error;
    const double error = by_place + by_scale + gamma(24) * (c_size + away * (2 * b_size + away * a_size));

    QuadraticSet set;
    if (given) {
      const double d_error = length(r.d_error) + gamma(1) * ld, s_slope_error = s_slope_error_ + gamma(1) * ls_slope;
      const double a_error = ab * ((2 * ld + ls_slope * lw) * d_error + lw * ld * s_slope_error + d_error * d_error) +
                             ak * lw * (d_error * ls_slope + ld * s_slope_error) + gamma(16) * a_size;
      const double b_error =
          ab * ((2 * p_most + s_most * lw) * d_error + 2 * ld * place +
                lw * (ld * scale_error + p_most * s_slope_error)) +
          ab * lw * ls_slope * place +
          ak * lw * (place * ls_slope + p_most * s_slope_error + d_error * s_most + ld * scale_error) +
          gamma(16) * b_size;
      if (a == 0 && b == 0) return;
      const BoundedRoot here, other = solve_deflated(a, b, a_error, b_error);
      const auto shape = a >= 0 ? QuadraticSet::Shape::between : QuadraticSet::Shape::outside;
      set = other.t >= 0 ? QuadraticSet{shape, here, other} : QuadraticSet{shape, other, here};
    } else {
      set = solve_quadratic(a, b, c, error);
    }
    if (set.shape == QuadraticSet::Shape::none || set.shape == QuadraticSet::Shape::all) return;

    const bool first_rises = set.shape == QuadraticSet::Shape::outside;
    for (const bool first : {true, false}) {
      const BoundedRoot& root = first ? set.first : set.second;
      const bool is_start = given && root.t == 0 && root.lo == 0 && root.hi == 0;
      if (is_start) {
        const double doubt = doubt_around_zero(2 * b, a, error + std::fabs(c));
        out.push_back(EdgeCrossing::at_start(index, first == first_rises, doubt, begin, end));
        continue;
      }
      const End moved = lateral_end(root, at, 0);
      EdgeCrossing crossing{{moved.t, moved.lo, moved.hi}, index, first == first_rises, false, false};
      crossing.lo = std::max(crossing.lo, begin);
      crossing.hi = std::min(crossing.hi, end);
      if (!(crossing.lo <= crossing.hi)) continue;
      // The arc is the part of the circle on its side of the chord.
      const BoundedLine m = along(bulge > 0 ? Vec2{w.y, -w.x} : Vec2{-w.y, w.x}, edge.from);
      const auto beyond = [&](double t) { return m.value + t * m.slope; };
      const double least = std::min(beyond(crossing.lo), beyond(crossing.hi));
      const double most = std::max(beyond(crossing.lo), beyond(crossing.hi));
      const double t_most = std::max(std::fabs(crossing.lo), std::fabs(crossing.hi));
      const double slack =
          m.value_error + t_most * m.slope_error + gamma(4) * (std::fabs(m.value) + t_most * std::fabs(m.slope));
      if (most < -slack) continue;
      crossing.sure = least > slack && crossing.lo > begin && crossing.hi < end;
      add(crossing, begin, end, out);
    }
  }

  Vec2 o_, d_, o_error_, d_error_;
  double s_ = 1, s_slope_ = 0, s_error_ = 0, s_slope_error_ = 0;
  int on_edge_;
  double first_ = 0, last_ = 0;  // where it is between the caps
  SearchedPart part_;
  Vec2 pad_;  // bound on the error of a box test
  std::vector<std::pair<double, double>> in_segments_;
};

}  // namespace tenon
