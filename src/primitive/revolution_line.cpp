#include "primitive/revolution_line.h"

#include "math/polynomial.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// v^(1/3) for v >= 0: Newton's method from v^(1/4 + 1/16 + 1/64), to a few last bits.
double cube_root(double v) {
  if (!(v > 0)) return 0;
  const double v4 = std::sqrt(std::sqrt(v)), v16 = std::sqrt(std::sqrt(v4)), v64 = std::sqrt(std::sqrt(v16));
  double x = v4 * v16 * v64;
  for (int i = 0; i < 6; ++i) x = (2 * x + v / (x * x)) / 3;
  return x;
}

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

/// q of an edge along the line, as find_bounded_roots wants it.
class Revolution::Line::Profile {
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
    const Vec2 at = line_.at(t) - edge_.from;
    const double e = line_.error(t), p = length(at), w = length(w_);
    return e * (length(edge_.normal(at)) + 2 * std::fabs(edge_.bulge) * e) +
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
class Revolution::Line::DeflatedProfile {
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

/// Adds the roots of an edge's function that may lie on the edge.
class Revolution::Line::RootCollector {
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
  void add_start(bool rising, double doubt) {
    out_.push_back(EdgeCrossing::at_start(index_, rising, doubt, begin_, end_));
  }

 private:
  const Line& line_;
  const OutlineEdge& edge_;
  std::uint32_t index_;
  double begin_, end_;
  std::vector<EdgeCrossing>& out_;
};

void Revolution::Line::cross_edge(std::uint32_t index, const OutlineEdge& edge, const LineWindow& window,
                                  std::vector<EdgeCrossing>& out) {
  // What lies on the axis bounds nothing.
  if (edge.from.x <= 0 && edge.to.x <= 0 && !edge.is_arc()) return;
  const bool given = on_edge_ == static_cast<int>(index);
  double begin = begin_, end = end_;
  if (!clip_to_box(edge.lower, edge.upper, begin, end)) return;
  const double more = beyond(begin, end);
  begin -= more;
  end += more;
  if (given) begin = std::min(begin, -more), end = std::max(end, more);
  if (!window.meets(begin, end)) return;

  const Profile f(*this, edge);
  RootCollector collect(*this, edge, index, begin, end, out);
  ShortList<CrossingRoot, 12> roots;
  const auto is_unsure = [&f](double t) { return !(std::fabs(f.value(t)) > f.error(t)); };
  const bool unsure_begin = is_unsure(begin), unsure_end = is_unsure(end);
  if (unsure_begin && unsure_end && f.lies_along(0.5 * begin + 0.5 * end)) {
    in_segments_.push_back(&edge);
    return;
  }
  if (given) {
    const DeflatedProfile g(f);
    find_roots(g, begin, end, f.turns(begin, end), roots);
    for (const CrossingRoot& root : roots) collect.add(root, root.rising == (root.t > 0));
    const double slope = g.value(0), error = f.error(0) + std::fabs(f.value(0));
    collect.add_start(slope > 0, doubt_around_zero(slope, f.half_curvature(0), error));
    return;
  }
  if (unsure_begin || unsure_end) collect.add_unknown();
  find_roots(f, begin, end, f.turns(begin, end), roots);
  for (const CrossingRoot& root : roots) collect.add(root, root.rising);
}

void Revolution::Line::cross_edges(const OutlineEdges& edges, const LineWindow& window,
                                   std::vector<EdgeCrossing>& out) {
  out.clear();
  in_segments_.clear();
  edges.visit_edges(
      [&](const Vec2& lower, const Vec2& upper) {
        double begin = begin_, end = end_;
        if (!clip_to_box(lower, upper, begin, end)) return false;
        const double more = beyond(begin, end);
        return window.meets(begin - more, end + more);
      },
      [&](std::uint32_t i) {
        cross_edge(i, edges.edges()[i], window, out);
        return true;
      });
  std::erase_if(out, [&](const EdgeCrossing& c) { return !window.meets(c.lo, c.hi); });
}

}  // namespace tenon
