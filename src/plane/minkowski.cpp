#include "plane/minkowski.h"

#include <algorithm>
#include <optional>

#include "plane/arc_corners.h"
#include "plane/clip.h"
#include "plane/offset.h"

namespace tenon {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;
// Directions nearer than this are one, off by the rounding of their corners.
constexpr double same_direction = 1e-11;
// A corner that turns to the right by less is the rounding of a tangent.
constexpr double least_dent = 1e-6;
constexpr std::size_t most_pairs = 200'000;

/// An edge of a convex outline, by the directions that it takes on its way.
struct ConvexEdge {
  OutlineEdge edge;
  double begin = 0, turn = 0;  // radians; begin in [0, 2 pi)
  Circle circle;               // of an arc

  bool covers(double direction) const {
    return edge.is_arc() && std::fmod(direction - begin + 2 * full_turn, full_turn) < turn;
  }
};

std::vector<ConvexEdge> convex_edges(const Outline& outline) {
  std::vector<ConvexEdge> result;
  const OutlineEdges edges(outline);
  for (const OutlineEdge& edge : edges.edges()) {
    ConvexEdge convex{edge, 0, 4 * std::atan(edge.bulge), {}};
    const Vec2 w = edge.chord();
    convex.begin = std::fmod(std::atan2(w.y, w.x) - convex.turn / 2 + 2 * full_turn, full_turn);
    if (edge.is_arc()) convex.circle = circle_of_arc(edge.from, edge.to, edge.bulge);
    result.push_back(convex);
  }
  return result;
}

Vec2 right_of(double direction) {
  return {std::sin(direction), -std::cos(direction)};
}

/// The sum of two convex outlines goes around both at once: in each direction the edges of both follow one another, and
/// the radii of arcs add up.
class ConvexSum {
 public:
  ConvexSum(const Outline& a, const Outline& b) : operands_{convex_edges(a), convex_edges(b)} {}

  Outline outline() {
    find_directions();
    Vec2 at = start(operands_[0]) + start(operands_[1]);
    std::vector<OutlineCorner> loop;
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      const double begin = directions_[i];
      const double turn = (i + 1 < directions_.size() ? directions_[i + 1] : directions_[0] + full_turn) - begin;
      const Vec2 ahead = segments_along(begin);
      if (ahead.x != 0 || ahead.y != 0) {
        loop.push_back({at.x, at.y, 0});
        at = at + ahead;
      }
      const double radius = radius_at(begin + turn / 2);
      if (radius == 0) continue;
      const Vec2 center = at - radius * right_of(begin);
      add_arc(center, at, turn, loop);
      at = center + radius * right_of(begin + turn);
    }
    return {{loop}};
  }

 private:
  void find_directions() {
    for (const auto& edges : operands_) {
      for (const ConvexEdge& edge : edges) {
        directions_.push_back(edge.begin);
        if (edge.edge.is_arc()) directions_.push_back(std::fmod(edge.begin + edge.turn, full_turn));
      }
    }
    std::sort(directions_.begin(), directions_.end());
    const auto is_same = [](double a, double b) { return b - a < same_direction; };
    directions_.erase(std::unique(directions_.begin(), directions_.end(), is_same), directions_.end());
    if (directions_.size() > 1 && directions_.front() + full_turn - directions_.back() < same_direction) {
      directions_.pop_back();
    }
  }

  static double between(double a, double b) {
    const double d = std::fabs(a - b);
    return std::min(d, full_turn - d);
  }

  Vec2 segments_along(double direction) const {
    Vec2 sum;
    for (const auto& edges : operands_) {
      for (const ConvexEdge& edge : edges) {
        if (!edge.edge.is_arc() && between(edge.begin, direction) < same_direction) sum = sum + edge.edge.chord();
      }
    }
    return sum;
  }

  double radius_at(double direction) const {
    double sum = 0;
    for (const auto& edges : operands_) {
      for (const ConvexEdge& edge : edges) {
        if (edge.covers(direction)) sum += edge.circle.radius;
      }
    }
    return sum;
  }

  // Where an operand is when its way takes the first direction.
  Vec2 start(const std::vector<ConvexEdge>& edges) const {
    const double first = directions_.front();
    const Vec2 n = right_of(first), ahead{-n.y, n.x};
    std::optional<Vec2> best;
    const auto consider = [&](const Vec2& p) {
      const double further = best ? dot(n, p - *best) : 0;
      const double near = same_direction * (best ? length(p - *best) : 0);
      if (!best || further > near || (further >= -near && dot(ahead, p - *best) < 0)) best = p;
    };
    for (const ConvexEdge& edge : edges) {
      consider(edge.edge.from);
      if (edge.covers(first)) consider(edge.circle.center + edge.circle.radius * n);
    }
    return *best;
  }

  std::vector<ConvexEdge> operands_[2];
  std::vector<double> directions_;  // in which an edge begins or an arc ends, ascending
};

// The circle that an outline is, if it is one.
std::optional<Circle> circle_of(const Outline& outline) {
  if (outline.loops.size() != 1) return std::nullopt;
  std::optional<Circle> circle;
  const OutlineEdges edges(outline);
  for (const OutlineEdge& edge : edges.edges()) {
    if (!edge.is_arc()) return std::nullopt;
    const Circle other = circle_of_arc(edge.from, edge.to, edge.bulge);
    if (!circle) circle = other;
    const double near = 0x1p-40 * (length(circle->center) + circle->radius);
    if (length(circle->center - other.center) + std::fabs(circle->radius - other.radius) > near) return std::nullopt;
  }
  return circle;
}

Outline moved(Outline outline, const Vec2& by) {
  for (auto& loop : outline.loops) {
    for (OutlineCorner& corner : loop) corner = {corner.x + by.x, corner.y + by.y, corner.bulge};
  }
  return outline;
}

// With chords for arcs.
Outline chopped(const Outline& outline) {
  constexpr double step = full_turn / 128;
  Outline result;
  for (const auto& corners : outline.loops) {
    auto& loop = result.loops.emplace_back();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const OutlineCorner &a = corners[i], &b = corners[(i + 1) % corners.size()];
      loop.push_back({a.x, a.y, 0});
      if (a.bulge == 0) continue;
      const Circle circle = circle_of_arc({a.x, a.y}, {b.x, b.y}, a.bulge);
      const double angle = 4 * std::atan(a.bulge);
      const int count = static_cast<int>(std::ceil(std::fabs(angle) / step));
      for (int k = 1; k < count; ++k) {
        const Vec2 p = circle.center + turned_by(Vec2{a.x, a.y} - circle.center, angle * k / count);
        loop.push_back({p.x, p.y, 0});
      }
    }
  }
  return result;
}

// Moved along the boundary of the other, the boundary of each sweeps a parallelogram with each edge; what is moved to
// one corner of each loop of the other lies inside.
Outline sum_of_polygons(const Outline& a, const Outline& b) {
  const double largest = largest_coordinate(a) + largest_coordinate(b);
  if (!has_grid(largest)) return {};
  Chords chords(largest);
  ClipperLib::Paths pieces;
  const auto add = [&](const Outline& outline, bool orient) {
    for (ClipperLib::Path& path : chords.add(outline)) {
      if (orient && !ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
      pieces.push_back(std::move(path));
    }
  };
  const OutlineEdges edges_a(a), edges_b(b);
  for (const OutlineEdge& e : edges_a.edges()) {
    for (const OutlineEdge& f : edges_b.edges()) {
      const Vec2 p = e.from + f.from, q = e.to + f.from, r = e.to + f.to, s = e.from + f.to;
      add({{{{p.x, p.y, 0}, {q.x, q.y, 0}, {r.x, r.y, 0}, {s.x, s.y, 0}}}}, true);
    }
  }
  // Loops that are holes keep their sense: so a hole stays one where nothing covers it.
  ClipperLib::Paths sum = clip(ClipperLib::ctUnion, pieces, {});
  for (const auto& [moving, fixed] : {std::pair{&a, &b}, {&b, &a}}) {
    for (const auto& loop : fixed->loops) {
      pieces.clear();
      add(moved(*moving, {loop.front().x, loop.front().y}), false);
      sum = clip(ClipperLib::ctUnion, sum, pieces);
    }
  }
  chords.index();
  return recover_outline(chords, sum);
}

}  // namespace

bool is_convex(const Outline& outline) {
  if (outline.loops.size() != 1) return false;
  const std::vector<ConvexEdge> edges = convex_edges(outline);
  double turn = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const ConvexEdge &edge = edges[i], &next = edges[(i + 1) % edges.size()];
    double corner = std::fmod(next.begin - edge.begin - edge.turn + 3 * full_turn, full_turn);
    if (corner > full_turn - least_dent) corner = 0;
    if (edge.turn < 0 || corner > std::numbers::pi) return false;
    turn += edge.turn + corner;
  }
  return std::fabs(turn - full_turn) < 1e-6;
}

Result<Outline> minkowski_sum(const Outline& a, const Outline& b) {
  if (a.loops.empty() || b.loops.empty()) return Outline{};
  const auto disc_a = circle_of(a), disc_b = circle_of(b);
  if (disc_a && disc_b) {
    return Outline{{full_circle({disc_a->center + disc_b->center, disc_a->radius + disc_b->radius}, 1)}};
  }
  if (is_convex(a) && is_convex(b)) return ConvexSum(a, b).outline();
  if (disc_b) return moved(offset(a, disc_b->radius, OffsetJoin::round), disc_b->center);
  if (disc_a) return moved(offset(b, disc_a->radius, OffsetJoin::round), disc_a->center);
  const Outline polygon_a = chopped(a), polygon_b = chopped(b);
  const auto count = [](const Outline& outline) {
    const OutlineEdges edges(outline);
    return edges.edges().size();
  };
  if (count(polygon_a) * count(polygon_b) > most_pairs) {
    return Error{ErrorKind::input,
                 "the shapes have too many edges to add each of one to each of the other; make one of them convex",
                 {}};
  }
  return sum_of_polygons(polygon_a, polygon_b);
}

}  // namespace tenon
