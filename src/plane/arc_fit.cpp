#include "plane/arc_fit.h"

#include <algorithm>

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

void fit(const ParametricCurve& curve, double begin, const Vec2& a, double end, const Vec2& b, double tolerance,
         int depth, std::vector<OutlineCorner>& loop) {
  const double middle = 0.5 * (begin + end);
  const Vec2 m = curve(middle);
  double bulge = bulge_through(a, m, b);
  // What is as good as straight is.
  if (std::fabs(bulge) * length(b - a) * 0.5 <= 0x1p-10 * tolerance) bulge = 0;
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

}  // namespace

void fit_arcs(const ParametricCurve& curve, double begin, double end, double tolerance,
              std::vector<OutlineCorner>& loop) {
  const Vec2 a = curve(begin), b = curve(end);
  // What rounding makes of points is no shape.
  const double rounding = 0x1p-44 * std::max(length(a), length(b));
  fit(curve, begin, a, end, b, std::max(tolerance, rounding), 0, loop);
}

}  // namespace tenon
