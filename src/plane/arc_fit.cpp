#include "plane/arc_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "primitive/arc.h"

namespace tenon {

namespace {

// Of arcs the error falls to an eighth with each halving; a curve that is not done by then is broken.
constexpr int deepest = 12;
// An arc that turns by more than a quarter is not told by one point in its middle.
constexpr double most_bulge = 0.2;

// The bulge of the arc from a to b through a point between them.
double bulge_through(const Vec2& a, const Vec2& m, const Vec2& b) {
  // The angle at m over the chord is half a turn less half of the arc's.
  const Vec2 u = m - a, v = b - m;
  const double half = std::atan2(cross(u, v), dot(u, v));
  return std::tan(half / 2);
}

double distance_from_arc(const Vec2& p, const Vec2& a, const Vec2& b, double bulge) {
  if (bulge == 0) return length(b - a) > 0 ? std::fabs(cross(b - a, p - a)) / length(b - a) : length(p - a);
  const Circle circle = circle_of_arc(a, b, bulge);
  return std::fabs(length(p - circle.center) - circle.radius);
}

// The bulge of the arc through three points; 0 where that is as good as straight.
double bulge_between(const Vec2& a, const Vec2& m, const Vec2& b, double tolerance) {
  const double bulge = bulge_through(a, m, b);
  return std::fabs(bulge) * length(b - a) * 0.5 <= 0x1p-10 * tolerance ? 0 : bulge;
}

void fit(const ParametricCurve& curve, double begin, const Vec2& a, double end, const Vec2& b, double tolerance,
         int depth, std::vector<OutlineCorner>& loop) {
  const double middle = 0.5 * (begin + end);
  const Vec2 m = curve(middle);
  const double bulge = bulge_between(a, m, b, tolerance);
  const bool fits = std::fabs(bulge) <= most_bulge &&
                    distance_from_arc(curve(0.5 * (begin + middle)), a, b, bulge) <= tolerance &&
                    distance_from_arc(curve(0.5 * (middle + end)), a, b, bulge) <= tolerance;
  if (fits || depth == deepest) {
    loop.push_back({a.x, a.y, fits ? bulge : 0});
    return;
  }
  fit(curve, begin, a, middle, m, tolerance, depth + 1, loop);
  fit(curve, middle, m, end, b, tolerance, depth + 1, loop);
}

/// Joins points of a closed curve by the longest arcs that fit, one after the other.
class PointFit {
 public:
  PointFit(std::span<const Vec2> points, double tolerance) : points_(points), tolerance_(tolerance) {
    // From behind the shortest edge, which is a corner if there is one.
    double shortest = HUGE_VAL;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double edge = length(points[(i + 1) % points.size()] - points[i]);
      if (edge < shortest) first_ = i + 1;
      shortest = std::min(shortest, edge);
    }
  }

  std::vector<OutlineCorner> corners() const {
    std::vector<OutlineCorner> loop;
    for (std::size_t begin = 0; begin < points_.size();) {
      // Lengths are doubled until one does not fit, and then halved back.
      std::size_t fits = 1, fails = fewest_steps;
      const std::size_t left = points_.size() - begin;
      while (fails <= left && bulge(begin, begin + fails)) {
        fits = fails;
        fails *= 2;
      }
      fails = std::min(fails, left + 1);
      while (fails - fits > 1) {
        const std::size_t middle = (fits + fails) / 2;
        (bulge(begin, begin + middle) ? fits : fails) = middle;
      }
      const Vec2 a = at(begin);
      loop.push_back({a.x, a.y, fits > 1 ? *bulge(begin, begin + fits) : 0});
      begin += fits;
    }
    return loop;
  }

 private:
  Vec2 at(std::size_t i) const { return points_[(first_ + i) % points_.size()]; }

  // Three points have an arc whatever is between them, and with one more there may be a corner beside it.
  static constexpr std::size_t fewest_steps = 4;

  // Of the arc from one point to another through one about half-way, if it fits those between; of few a segment alone.
  std::optional<double> bulge(std::size_t begin, std::size_t end) const {
    const Vec2 a = at(begin), b = at(end), w = b - a;
    std::size_t middle = begin + 1;
    const auto off = [&](std::size_t i) { return std::fabs(dot(at(i) - 0.5 * (a + b), w)); };
    for (std::size_t i = begin + 2; i < end; ++i) {
      if (off(i) < off(middle)) middle = i;
    }
    const double result = end - begin < fewest_steps ? 0 : bulge_between(a, at(middle), b, tolerance_);
    if (!(std::fabs(result) <= most_bulge)) return std::nullopt;
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (!(distance_from_arc(at(i), a, b, result) <= tolerance_)) return std::nullopt;
    }
    return result;
  }

  std::span<const Vec2> points_;
  double tolerance_;
  std::size_t first_ = 0;
};

}  // namespace

std::vector<OutlineCorner> fit_arcs(std::span<const Vec2> points, double tolerance) {
  return PointFit(points, tolerance).corners();
}

void fit_arcs(const ParametricCurve& curve, double begin, double end, double tolerance,
              std::vector<OutlineCorner>& loop) {
  const Vec2 a = curve(begin), b = curve(end);
  // What rounding makes of points is no shape.
  const double rounding = 0x1p-44 * std::max(length(a), length(b));
  fit(curve, begin, a, end, b, std::max(tolerance, rounding), 0, loop);
}

}  // namespace tenon
