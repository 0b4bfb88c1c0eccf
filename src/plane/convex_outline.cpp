#include "plane/convex_outline.h"

#include <algorithm>
#include <optional>

#include "math/vec2.h"
#include "plane/arc_corners.h"
#include "primitive/outline_edges.h"

namespace tenon {

namespace {

// Points of an arc are so far apart. Which arcs the hull touches, and in which order, is found by points; where two
// arcs touch it within one step, the deeper one by less than the sagitta (1e-5 of the radius) may be passed over.
constexpr double step = 2 * std::numbers::pi / 720;

/// A corner, or a point within an arc.
struct Sample {
  Vec2 point;
  Circle circle;  // of radius 0 for a corner
  bool is_corner() const { return circle.radius == 0; }
};

/// Samples of the hull that follow one another on one circle; or one corner.
struct Side {
  Sample first, last;
  double turn = 0;  // from the first to the last, in radians
};

void add_samples(const OutlineEdge& edge, std::vector<Sample>& samples) {
  samples.push_back({edge.from, {edge.from, 0}});
  if (!edge.is_arc()) return;
  const Circle circle = circle_of_arc(edge.from, edge.to, edge.bulge);
  const double angle = 4 * std::atan(edge.bulge);
  // Samples that touch a corner would only be taken for it.
  const int count = std::max(2, static_cast<int>(std::ceil(std::fabs(angle) / step)));
  const auto add = [&](double part) {
    samples.push_back({circle.center + turned_by(edge.from - circle.center, angle * part / count), circle});
  };
  for (int i = 1; i < count; ++i) add(i);
  // A tangent that touches the arc next to its end leaves the corner there inside. Within 2⁻²¹ an arc cannot be told
  // from its tangent by more than rounding.
  constexpr int halvings = 14;
  double part = 1;
  for (int i = 0; i < halvings; ++i) {
    part /= 2;
    add(part);
    add(count - part);
  }
}

// Andrew's monotone chain, counterclockwise.
std::vector<Sample> hull_of(std::vector<Sample> samples) {
  std::stable_sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return a.point.x != b.point.x ? a.point.x < b.point.x : a.point.y < b.point.y;
  });
  std::vector<Sample> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto s = begin; s != end; ++s) {
      while (hull.size() >= first + 2 &&
             cross(hull.back().point - hull[hull.size() - 2].point, s->point - hull.back().point) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*s);
    }
    hull.pop_back();  // the other chain begins there
  };
  add_chain(samples.begin(), samples.end());
  add_chain(samples.rbegin(), samples.rend());
  return hull;
}

// From one sample to another around the circle of the first.
double turn_between(const Sample& a, const Vec2& b) {
  return angle_between(a.point - a.circle.center, b - a.circle.center);
}

// What rounding may make of one circle's centre and radius.
double rounding(const Circle& circle) {
  return 0x1p-40 * (circle.radius + length(circle.center));
}

bool is_on(const Circle& circle, const Vec2& p) {
  return std::fabs(length(p - circle.center) - circle.radius) <= rounding(circle);
}

bool is_next_on_circle(const Sample& a, const Sample& b) {
  if (a.is_corner() || b.is_corner()) return false;
  const double near = rounding(a.circle);
  if (length(a.circle.center - b.circle.center) > near || std::fabs(a.circle.radius - b.circle.radius) > near) {
    return false;
  }
  const double turn = turn_between(a, b.point);
  return turn >= 0 && turn <= 2.5 * step;
}

// A corner in which an arc goes on on the same circle is a point of it like others.
void smooth_corners(std::vector<Sample>& hull) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Sample &before = hull[(i + hull.size() - 1) % hull.size()], &next = hull[(i + 1) % hull.size()];
    if (hull[i].is_corner() && is_next_on_circle(before, next) && is_on(before.circle, hull[i].point)) {
      hull[i].circle = before.circle;
    }
  }
}

std::vector<Side> sides_of(const std::vector<Sample>& hull) {
  std::vector<Side> sides;
  for (const Sample& sample : hull) {
    if (!sides.empty() && is_next_on_circle(sides.back().last, sample)) {
      sides.back().turn += turn_between(sides.back().last, sample.point);
      sides.back().last = sample;
    } else {
      sides.push_back({sample, sample});
    }
  }
  if (sides.size() > 1 && is_next_on_circle(sides.back().last, sides.front().first)) {
    const double turn = turn_between(sides.back().last, sides.front().first.point);
    sides.front().turn += sides.back().turn + turn;
    sides.front().first = sides.back().first;
    sides.pop_back();
  }
  return sides;
}

// The points in which a line touches two circles that lie to the left of it; one may be a point.
std::optional<std::pair<Vec2, Vec2>> tangent(const Circle& a, const Circle& b) {
  const Vec2 w = b.center - a.center;
  const double d = length(w);
  // With n to the right of the line and w along it, n·w = ra - rb.
  const double along = (a.radius - b.radius) / d;
  if (!(std::fabs(along) <= 1)) return std::nullopt;
  const double across = std::sqrt((1 - along) * (1 + along));
  const Vec2 u = 1 / d * w, n = along * u + across * Vec2{u.y, -u.x};
  return std::pair{a.center + a.radius * n, b.center + b.radius * n};
}

// Whether a tangent touches the circle next to the sample that is nearest to where the hull leaves it.
bool is_next_to(const Sample& sample, const Circle& circle, const Vec2& p) {
  return circle.radius == 0 || std::fabs(turn_between(sample, p)) <= 1.5 * step;
}

// Whether a corner is the end of the arc that a sample lies on.
bool ends_arc(const Sample& corner, const Sample& sample) {
  return corner.is_corner() && !sample.is_corner() && is_on(sample.circle, corner.point) &&
         is_next_to(sample, sample.circle, corner.point);
}

// The ends of the edge of the hull from one side to the next: a tangent of circles, or a corner where an arc ends.
std::pair<Vec2, Vec2> edge_between(const Side& a, const Side& b) {
  const Sample &from = a.last, &to = b.first;
  if (ends_arc(to, from)) return {to.point, to.point};
  if (ends_arc(from, to)) return {from.point, from.point};
  const auto ends = tangent(from.circle, to.circle);
  if (ends && is_next_to(from, from.circle, ends->first) && is_next_to(to, to.circle, ends->second)) return *ends;
  return {from.point, to.point};
}

}  // namespace

Outline convex_hull(const Outline& outline) {
  std::vector<Sample> samples;
  const OutlineEdges edges_of_outline(outline);
  for (const OutlineEdge& edge : edges_of_outline.edges()) add_samples(edge, samples);
  if (samples.size() < 2) return {};
  std::vector<Sample> hull = hull_of(std::move(samples));
  if (hull.size() < 3) return {};
  smooth_corners(hull);
  const std::vector<Side> sides = sides_of(hull);
  Outline result;
  auto& loop = result.loops.emplace_back();
  if (sides.size() == 1) {
    loop = full_circle(sides[0].first.circle, 1);
    return result;
  }
  std::vector<std::pair<Vec2, Vec2>> edges;
  for (std::size_t i = 0; i < sides.size(); ++i) edges.push_back(edge_between(sides[i], sides[(i + 1) % sides.size()]));
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const Vec2 begin = edges[(i + sides.size() - 1) % sides.size()].second, end = edges[i].first;
    const Circle& circle = sides[i].first.circle;
    double angle = angle_between(begin - circle.center, end - circle.center);
    constexpr double full = 2 * std::numbers::pi;
    angle += full * std::round((sides[i].turn - angle) / full);
    const auto is_last = [&](const Vec2& p) { return !loop.empty() && loop.back().x == p.x && loop.back().y == p.y; };
    if (circle.radius > 0 && angle > 0 && !(begin == end)) {
      if (is_last(begin)) loop.pop_back();
      add_arc(circle.center, begin, angle, loop);
    }
    if (!is_last(end)) loop.push_back({end.x, end.y, 0});
  }
  while (loop.size() > 1 && loop.back().x == loop.front().x && loop.back().y == loop.front().y) loop.pop_back();
  return result;
}

}  // namespace tenon
