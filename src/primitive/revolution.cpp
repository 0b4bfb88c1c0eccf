#include "primitive/revolution.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "primitive/box_tests.h"
#include "primitive/check.h"

namespace tenon {

std::string Revolution::check() const {
  if (std::string problem = check_outline(name, outline); !problem.empty()) return problem;
  // A circle that touches the axis may reach over it by the rounding of its box.
  const Vec2 reach = edges_.reach();
  if (edges_.lower().x < -gamma(64) * (reach.x + reach.y)) {
    return "revolution has an outline that reaches over the axis; keep the distances at least 0";
  }
  if (!(edges_.upper().x > 0)) return "revolution has an outline without distance from the axis, and no volume";
  return {};
}

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
  friend class Profile;
  friend class DeflatedProfile;

  Vec2 o_, d_;
  double z_, z_slope_;
  double o_error_, d_error_, z_error_, z_slope_error_;
  double a_, t_nearest_, nearest_;
  double size_;
  double begin_ = 0, end_ = 0, pad_ = 0;
};

namespace {

// v^(1/3) for v >= 0: Newton's method from v^(1/4 + 1/16 + 1/64), to a few last bits.
double cube_root(double v) {
  if (!(v > 0)) return 0;
  const double v4 = std::sqrt(std::sqrt(v)), v16 = std::sqrt(std::sqrt(v4)), v64 = std::sqrt(std::sqrt(v16));
  double x = v4 * v16 * v64;
  for (int i = 0; i < 6; ++i) x = (2 * x + v / (x * x)) / 3;
  return x;
}

}  // namespace

/// q of an edge along the line, as find_bounded_roots wants it.
class Revolution::Profile {
 public:
  Profile(const Line& line, const OutlineEdge& edge) : line_(line), edge_(edge), w_(edge.chord()) {}

  double value(double t) const { return edge_.value(line_.at(t) - edge_.from); }
  double slope(double t) const {
    const Vec2 n = edge_.normal(line_.at(t) - edge_.from);
    return n.x * radial_slope(t) + n.y * line_.z_slope_;
  }
  double half_curvature(double t) const {
    const double rho = line_.radius(t), s = radial_slope(t);
    const Vec2 n = edge_.normal(line_.at(t) - edge_.from);
    const double bend = rho > 0 ? (line_.a_ - s * s) / rho : 0;
    return edge_.bulge * (s * s + line_.z_slope_ * line_.z_slope_) + 0.5 * n.x * bend;
  }
  double error(double t) const {
    const double e = line_.error(t), p = length(line_.at(t) - edge_.from), w = length(w_);
    return e * edge_.steepness(p + e) +
           gamma(16) * (std::fabs(edge_.bulge) * p * (p + w) + std::fabs(edge_.flatness()) * w * p);
  }

  /// Whether the line lies in the surface at t in place and direction, as far as can be told.
  bool lies_along(double t) const {
    const double steep = edge_.steepness(length(line_.at(t) - edge_.from) + line_.error(t));
    const double turn = line_.d_error_ + line_.z_slope_error_ + gamma(8) * line_.speed();
    return std::fabs(value(t)) <= error(t) && std::fabs(slope(t)) <= steep * turn;
  }

  /// Where the slope changes its sign. It is A τ + B + C ρ'(τ), τ being t from the place nearest to the axis; its own
  /// slope A + C a nearest² / ρ³ changes sign where ρ³ is a given number, at ±τ.
  ShortList<double, 4> turns(double begin, double end) const {
    const double a = line_.a_, dz = line_.z_slope_, b = edge_.bulge, k = edge_.flatness();
    const double middle_z = line_.z_ + line_.t_nearest_ * dz - edge_.from.y;
    const double A = 2 * b * (a + dz * dz), B = dz * (b * (2 * middle_z - w_.y) - k * w_.x);
    const double C = k * w_.y - b * (2 * edge_.from.x + w_.x);
    ShortList<double, 4> found;
    if (b == 0) {
      // B + C ρ' = 0
      const double s = -B / C, m = line_.nearest_;
      if (!(s * s < a)) return found;
      const double t = line_.t_nearest_ + m * s / std::sqrt(a * (a - s * s));
      if (t > begin && t < end) found.push_back(t);
      return found;
    }
    const double cube = cube_root(-C * a * line_.nearest_ * line_.nearest_ / A);
    const double square = (cube - line_.nearest_) * (cube + line_.nearest_) / a;
    double splits[4] = {begin, begin, end, end};
    if (square >= 0 && (C < 0) != (A < 0)) {
      // A line through the axis has a kink there; the two places stay apart.
      const double tau = std::max(std::sqrt(square), 0x1p-48 * (end - begin));
      splits[1] = std::clamp(line_.t_nearest_ - tau, begin, end);
      splits[2] = std::clamp(line_.t_nearest_ + tau, begin, end);
    } else {
      splits[1] = splits[2] = end;
    }
    const Slope f{*this};
    for (int i = 0; i < 3; ++i) {
      if (!(splits[i] < splits[i + 1])) continue;
      const double low = slope(splits[i]), high = slope(splits[i + 1]);
      if ((low < 0) == (high < 0)) continue;
      const double t = find_sign_change(f, splits[i], splits[i + 1], low, high);
      if (t > begin && t < end && (found.empty() || t > found[found.size() - 1])) found.push_back(t);
    }
    return found;
  }

 private:
  friend class DeflatedProfile;

  struct Slope {
    const Profile& profile;
    double value(double t) const { return profile.slope(t); }
    double slope(double t) const { return 2 * profile.half_curvature(t); }
  };

  double radial_slope(double t) const {
    const double rho = line_.radius(t);
    return rho > 0 ? dot(line_.o_ + t * line_.d_, line_.d_) / rho : 0;
  }

  const Line& line_;
  const OutlineEdge& edge_;
  Vec2 w_;
};

/// The same for a line that is known to lie on the surface at t = 0, divided by t. Between t = 0 and t the place moves
/// by t (k, z'), k = (ρ² - ρ0²) / (t (ρ + ρ0)).
class Revolution::DeflatedProfile {
 public:
  explicit DeflatedProfile(const Profile& profile) : f_(profile), start_(f_.line_.at(0)) {}

  double value(double t) const {
    const Vec2 way = mean_way(t), p = f_.line_.at(t) - f_.edge_.from, p0 = start_ - f_.edge_.from;
    return f_.edge_.bulge * dot(way, p + p0 - f_.w_) - f_.edge_.flatness() * cross(f_.w_, way);
  }
  // As if t did not change: what is asked is where the undivided function turns.
  double slope(double t) const { return t == 0 ? 0 : f_.slope(t) / t; }
  double half_curvature(double t) const { return t == 0 ? 0 : f_.half_curvature(t) / t; }
  double error(double t) const {
    const Line& line = f_.line_;
    const Vec2 way = mean_way(t), p = line.at(t) - f_.edge_.from, p0 = start_ - f_.edge_.from;
    const double e = line.error(t), s = std::fabs(t), d = length(line.d_), lo = length(line.o_);
    const double sum = line.radius(t) + start_.x;
    const double way_error =
        (2 * (lo * line.d_error_ + d * line.o_error_) + 2 * d * line.d_error_ * s + std::fabs(way.x) * 2 * e) / sum +
        line.z_slope_error_ + gamma(8) * (2 * lo * d + line.a_ * s) / sum + gamma(2) * length(way);
    const double ab = std::fabs(f_.edge_.bulge),
                 steep = ab * length(p + p0 - f_.w_) + std::fabs(f_.edge_.flatness()) * length(f_.w_);
    const double by_terms = steep * way_error + 2 * ab * e * (length(way) + way_error) +
                            gamma(16) * (ab * length(way) * (length(p) + length(p0) + length(f_.w_)) +
                                         std::fabs(f_.edge_.flatness()) * length(f_.w_) * length(way));
    const double by_value = (f_.error(t) + f_.error(0) + std::fabs(f_.value(0))) / s;
    return by_value < by_terms || !std::isfinite(by_terms) ? by_value : by_terms;
  }

 private:
  Vec2 mean_way(double t) const {
    const Line& line = f_.line_;
    const double sum = line.radius(t) + start_.x;
    return {sum > 0 ? (2 * dot(line.o_, line.d_) + line.a_ * t) / sum : 0, line.z_slope_};
  }

  const Profile& f_;
  Vec2 start_;
};

namespace {

// Adds the roots of an edge's function that may lie on the edge.
template <class Line>
class RootCollector {
 public:
  RootCollector(const Line& line, const OutlineEdge& edge, std::uint32_t index, double begin, double end,
                std::vector<EdgeCrossing>& out)
      : line_(line), edge_(edge), index_(index), begin_(begin), end_(end), out_(out) {}

  void add(const BoundedRoot& root, bool rising) {
    EdgeCrossing crossing{root, index_, rising, false, false};
    crossing.lo = std::max(root.lo, begin_) - gamma(2) * std::fabs(root.lo);
    crossing.hi = std::min(root.hi, end_) + gamma(2) * std::fabs(root.hi);
    const Vec2 p = line_.at(root.t) - edge_.from, w = edge_.chord();
    const double away = line_.speed() * std::max(crossing.hi - root.t, root.t - crossing.lo) * (1 + gamma(8));
    const double l = length(w);
    const double slack = l * (away + line_.error(root.t)) * (1 + gamma(8)) + gamma(8) * l * (length(p) + l);
    double least = 0;
    if (edge_.is_arc()) {
      least = edge_.side(p);
    } else {
      const double along = dot(w, p);
      least = std::min(along, l * l - along);
    }
    if (least < -slack || !(crossing.lo <= crossing.hi)) return;
    crossing.sure = least > slack && root.lo > begin_ && root.hi < end_;
    out_.push_back(crossing);
  }
  void add_unknown() { out_.push_back({{0.5 * begin_ + 0.5 * end_, begin_, end_}, index_, false, false, false}); }
  void add_start(bool rising) { out_.push_back({{0, 0, 0}, index_, rising, true, true}); }

 private:
  const Line& line_;
  const OutlineEdge& edge_;
  std::uint32_t index_;
  double begin_, end_;
  std::vector<EdgeCrossing>& out_;
};

template <class F>
void find_roots(const F& f, double begin, double end, const ShortList<double, 4>& turns,
                ShortList<CrossingRoot, 12>& roots) {
  std::array<double, 6> splits;
  std::size_t count = 0;
  splits[count++] = begin;
  for (const double turn : turns) {
    if (turn > splits[count - 1] && turn < end) splits[count++] = turn;
  }
  splits[count++] = end;
  find_bounded_roots(f, std::span<const double>(splits.data(), count), roots);
}

}  // namespace

void Revolution::spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const {
  Line line(ray, edges_);
  if (!line.find_part(edges_)) return;
  const SearchedPart part = SearchedPart{line.begin(), line.end(), true, true}.within(window);
  if (part.is_empty()) return;
  thread_local std::vector<EdgeCrossing> crossings;
  thread_local std::vector<BoundaryCrossing> boundary;
  thread_local std::vector<std::uint32_t> along;
  crossings.clear();
  along.clear();

  const auto cross_edge = [&](std::uint32_t i) {
    const OutlineEdge& edge = edges_.edges()[i];
    // What lies on the axis bounds nothing.
    if (edge.from.x <= 0 && edge.to.x <= 0 && !edge.is_arc()) return true;
    const bool given = ray.on_face >= 0 && static_cast<std::uint32_t>(ray.on_face) / 2 == i;
    double begin = line.begin(), end = line.end();
    if (!line.clip_to_box(edge.lower, edge.upper, begin, end)) return true;
    // Beyond the edge, so that its crossings are well within.
    const double more = 0.0625 * (end - begin) + 4 * (line.error(begin) + line.error(end)) / line.speed();
    begin -= more;
    end += more;
    if (given) begin = std::min(begin, -more), end = std::max(end, more);
    if (!window.meets(begin, end)) return true;

    const Profile f(line, edge);
    RootCollector collect(line, edge, i, begin, end, crossings);
    ShortList<CrossingRoot, 12> roots;
    const auto is_unsure = [&f](double t) { return !(std::fabs(f.value(t)) > f.error(t)); };
    const bool unsure_begin = is_unsure(begin), unsure_end = is_unsure(end);
    if (unsure_begin && unsure_end && f.lies_along(0.5 * begin + 0.5 * end)) {
      along.push_back(i);
      return true;
    }
    if (given) {
      const DeflatedProfile g(f);
      find_roots(g, begin, end, f.turns(begin, end), roots);
      for (const CrossingRoot& root : roots) collect.add(root, root.rising == (root.t > 0));
      collect.add_start(g.value(0) > 0);
      return true;
    }
    if (unsure_begin || unsure_end) collect.add_unknown();
    find_roots(f, begin, end, f.turns(begin, end), roots);
    for (const CrossingRoot& root : roots) collect.add(root, root.rising);
    return true;
  };
  edges_.visit_edges(
      [&](const Vec2& lower, const Vec2& upper) {
        double begin = line.begin(), end = line.end();
        return line.clip_to_box(lower, upper, begin, end);
      },
      cross_edge);
  std::erase_if(crossings, [&](const EdgeCrossing& c) { return !window.meets(c.lo, c.hi); });

  const auto is_inside = [&](double t) {
    const Vec2 place = line.at(t);
    // In a surface that the line lies in, inside and outside are both right.
    return edges_.contains(place) || std::any_of(along.begin(), along.end(), [&](std::uint32_t i) {
             const OutlineEdge& edge = edges_.edges()[i];
             const double at = dot(edge.chord(), place - edge.from);
             return at >= 0 && at <= dot(edge.chord(), edge.chord());
           });
  };
  bool inside = find_boundary_crossings(crossings, part, is_inside, boundary);
  const std::size_t first = out.size();
  End enter = Chord().enter;
  for (const BoundaryCrossing& c : boundary) {
    if (c.entering) {
      enter = c.end;
    } else {
      emit_chord({enter, c.end}, out);
    }
    inside = c.entering;
  }
  if (inside) emit_chord({enter, Chord().leave}, out);
  put_in_order(first, out);
}

// With u the direction from the axis to the box's middle and v across it, the distance from the axis changes over the
// box as along u, and by at most the square of the way along v over twice the least distance more.
Region Revolution::classify(const LocalBox& box) const {
  const Vec3& c = box.center;
  const double middle = std::sqrt(c.x * c.x + c.y * c.y);
  const Vec3 u = middle > 0 ? Vec3{c.x / middle, c.y / middle, 0} : Vec3{1, 0, 0}, v{-u.y, u.x, 0};
  const Extent radial = extent_along(box, u), sideways = extent_along(box, v);
  const double aside = std::fabs(sideways.center) + sideways.radius;
  const double rounding = gamma(16) * (reach(box).x + reach(box).y);
  const double least = radial.least() - rounding,
               most = std::max(std::fabs(radial.greatest()), std::fabs(radial.least())) + rounding;
  const Vec2 lower{std::max(least, 0.0), box.bounds.lower.z};
  const Vec2 upper{std::sqrt(most * most + aside * aside) * (1 + gamma(4)), box.bounds.upper.z};
  const auto overlaps = [&](const Vec2& a, const Vec2& b) {
    return a.x <= upper.x && lower.x <= b.x && a.y <= upper.y && lower.y <= b.y;
  };
  const Vec2 place{middle, c.z};
  const double bend = least > 0 ? 0.5 * aside * aside / least : HUGE_VAL;
  const auto may_touch = [&](const OutlineEdge& edge) {
    const Vec2 p = place - edge.from, n = edge.normal(p);
    const Vec3 slope = n.x * u + Vec3{0, 0, n.y};
    double first_order = dot(abs(slope), box.error), away = length(box.error);
    for (const Vec3& half_edge : box.half_edges) {
      first_order += std::fabs(dot(slope, half_edge));
      away += length(half_edge);
    }
    const double size = length(p) + away + length(edge.from);
    const double change = first_order + std::fabs(edge.bulge) * away * away + std::fabs(n.x) * bend +
                          gamma(32) * size * (edge.steepness(size) + std::fabs(edge.bulge) * size);
    return !(std::fabs(edge.value(p)) > change * (1 + gamma(8)));
  };
  const bool clear = edges_.visit_edges(overlaps, [&](std::uint32_t i) { return !may_touch(edges_.edges()[i]); });
  if (!clear) return Region::straddles;
  return edges_.contains(place) ? Region::inside : Region::outside;
}

Vec3 Revolution::normal(const Vec3& point, std::uint32_t face) const {
  const OutlineEdge& edge = edges_.edges()[face / 2];
  const double across = std::sqrt(point.x * point.x + point.y * point.y);
  const Vec2 n = edge.normal(Vec2{across, point.z} - edge.from);
  Vec3 outward{0, 0, n.y};
  if (across > 0) outward += n.x / across * Vec3{point.x, point.y, 0};
  if (outward == Vec3{}) outward.z = 1;
  return face % 2 == 0 ? outward : -outward;
}

}  // namespace tenon
