#include "primitive/outline_edges.h"

#include "primitive/arc.h"
#include "primitive/check.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// An arc flatter than this is bounded by the rectangle around it: through its centre its extent would cancel.
constexpr double flat_bulge = 0x1p-6;

Circle circle_of(const OutlineEdge& edge) {
  return circle_of_arc(edge.from, edge.to, edge.bulge);
}

// The far side of the rectangle around an arc of at most a half turn.
Vec2 rise(const OutlineEdge& edge) {
  const Vec2 w = edge.chord();
  return 0.5 * edge.bulge * Vec2{w.y, -w.x};
}

void find_box(OutlineEdge& edge) {
  edge.lower = min(edge.from, edge.to);
  edge.upper = max(edge.from, edge.to);
  if (!edge.is_arc()) return;
  const auto take = [&edge](const Vec2& p) {
    edge.lower = min(edge.lower, p);
    edge.upper = max(edge.upper, p);
  };
  Vec2 terms{};
  if (std::fabs(edge.bulge) < flat_bulge) {
    take(edge.from + rise(edge));
    take(edge.to + rise(edge));
  } else {
    // Of the circle's ends along the axes those count that lie on the arc's side of the chord.
    const auto [c, r] = circle_of(edge);
    for (const Vec2& end : {c - Vec2{r, 0}, c + Vec2{r, 0}, c - Vec2{0, r}, c + Vec2{0, r}}) {
      if ((cross(edge.chord(), end - edge.from) < 0) == (edge.bulge > 0)) take(end);
    }
    terms = abs(c) + Vec2{r, r};
  }
  // A dozen roundings of terms no larger than the box, the coordinates and the circle.
  const Vec2 size = edge.upper - edge.lower + max(abs(edge.lower), abs(edge.upper)) + terms;
  edge.lower = edge.lower - gamma(16) * size;
  edge.upper = edge.upper + gamma(16) * size;
}

}  // namespace

OutlineEdge OutlineEdge::between(const Vec2& from, const Vec2& to, double bulge) {
  OutlineEdge edge{from, to, bulge, {}, {}};
  find_box(edge);
  return edge;
}

OutlineEdges::OutlineEdges(const Outline& outline) {
  for (const auto& loop : outline.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
      edges_.push_back(OutlineEdge::between({a.x, a.y}, {b.x, b.y}, a.bulge));
    }
  }
  // A corner that is given twice has an edge of no length, which bounds nothing.
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    if (edges_[i].from != edges_[i].to) order_.push_back(i);
  }
  if (order_.empty()) return;
  build(0, 0, static_cast<std::uint32_t>(order_.size()));
  find_extreme_points();
}

// Halves by the middles of the boxes along the longer side.
void OutlineEdges::build(std::size_t node, std::uint32_t first, std::uint32_t count) {
  constexpr std::uint32_t most_edges = 4;
  Vec2 lower = edges_[order_[first]].lower, upper = edges_[order_[first]].upper;
  for (std::uint32_t i = first; i < first + count; ++i) {
    lower = min(lower, edges_[order_[i]].lower);
    upper = max(upper, edges_[order_[i]].upper);
  }
  nodes_[node].lower = lower;
  nodes_[node].upper = upper;
  if (count <= most_edges) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const bool wide = upper.x - lower.x > upper.y - lower.y;
  const auto middle = [&](std::uint32_t i) {
    const OutlineEdge& e = edges_[i];
    return wide ? 0.5 * e.lower.x + 0.5 * e.upper.x : 0.5 * e.lower.y + 0.5 * e.upper.y;
  };
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    return middle(a) != middle(b) ? middle(a) < middle(b) : a < b;
  });
  const std::size_t child = nodes_.size();
  nodes_[node].first = static_cast<std::uint32_t>(child);
  nodes_.resize(child + 2);
  build(child, first, count / 2);
  build(child + 1, first + count / 2, count - count / 2);
}

// Andrew's monotone chain; what rounding drops lies within the rounding that support() adds.
void OutlineEdges::find_extreme_points() {
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const OutlineEdge& edge = edges_[i];
    points.push_back(edge.from);
    if (!edge.is_arc()) continue;
    if (std::fabs(edge.bulge) < flat_bulge) {
      points.push_back(edge.from + rise(edge));
      points.push_back(edge.to + rise(edge));
    } else {
      round_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t first = extreme_points_.size();
    for (auto p = begin; p != end; ++p) {
      while (extreme_points_.size() >= first + 2 &&
             cross(extreme_points_.back() - extreme_points_[extreme_points_.size() - 2], *p - extreme_points_.back()) <=
                 0) {
        extreme_points_.pop_back();
      }
      extreme_points_.push_back(*p);
    }
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
}

// The parity of the polygon of chords, and of the caps between the chords and their arcs. Which side of its chord the
// point lies on is asked once for both, so that there is no seam between them; one that lies on a line through corners
// counts as a little above it, and then a little to the right.
bool OutlineEdges::contains(const Vec2& p) const {
  bool inside = false;
  const auto lies_left_of = [&](const Vec2& lower, const Vec2& upper) {
    return p.y >= lower.y && p.y <= upper.y && p.x <= upper.x;
  };
  visit_edges(lies_left_of, [&](std::uint32_t i) {
    const OutlineEdge& edge = edges_[i];
    const Vec2 q = p - edge.from;
    const Vec2 w = edge.chord();
    const double side = cross(w, q);
    const bool left = side != 0 ? side > 0 : w.x != 0 ? w.x > 0 : w.y < 0;
    const bool rises = edge.from.y <= p.y && p.y < edge.to.y, falls = edge.to.y <= p.y && p.y < edge.from.y;
    inside ^= (rises && left) || (falls && !left);
    if (edge.bulge > 0) inside ^= !left && edge.value(q) < 0;
    if (edge.bulge < 0) inside ^= left && edge.value(q) > 0;
    return true;
  });
  return inside;
}

bool OutlineEdges::is_near_edge(const Vec2& p, double distance) const {
  const Vec2 around{distance, distance};
  const auto touches = [&](const Vec2& lower, const Vec2& upper) {
    const Vec2 a = p + around, b = p - around;
    return lower.x <= a.x && b.x <= upper.x && lower.y <= a.y && b.y <= upper.y;
  };
  return !visit_edges(touches, [&](std::uint32_t i) {
    const OutlineEdge& edge = edges_[i];
    const Vec2 q = p - edge.from;
    return std::fabs(edge.value(q)) > distance * edge.steepness(length(q) + distance);
  });
}

double OutlineEdges::support(const Vec2& n) const {
  double greatest = extreme_points_.empty() ? 0 : -HUGE_VAL;
  for (const Vec2& p : extreme_points_) greatest = std::max(greatest, dot(n, p));
  const double n_length = length(n);
  double size = length(reach());
  for (const std::uint32_t i : round_) {
    const OutlineEdge& edge = edges_[i];
    const auto [c, r] = circle_of(edge);
    size = std::max(size, length(c) + r);
    const Vec2 farthest = n_length > 0 ? c + r / n_length * n : c;
    if (edge.side(farthest - edge.from) > 0) greatest = std::max(greatest, dot(n, c) + r * n_length);
  }
  return greatest + gamma(16) * size * n_length;
}

std::string check_outline(std::string_view kind, const Outline& outline) {
  double largest = 0, area = 0;
  std::size_t corners = 0;
  for (std::size_t l = 0; l < outline.loops.size(); ++l) {
    const auto& loop = outline.loops[l];
    if (loop.size() < 2) return "an outline of " + std::string(kind) + " needs at least two corners in each loop";
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const OutlineCorner &c = loop[i], &next = loop[(i + 1) % loop.size()];
      const std::string corner = "corner " + std::to_string(i) +
                                 (outline.loops.size() > 1 ? " of loop " + std::to_string(l) : "") +
                                 " of the outline of " + std::string(kind);
      if (!std::isfinite(c.x + c.y + c.bulge)) return corner + " is not finite";
      if (std::fabs(c.bulge) > 1e3) return corner + " has a bulge beyond 1000, an arc that is all but a full circle";
      largest = std::max({largest, std::fabs(c.x), std::fabs(c.y)});
      area = std::max(area, std::fabs(c.x - next.x) + std::fabs(c.y - next.y));
      ++corners;
    }
  }
  if (corners == 0) return std::string(kind) + " with an outline of no corners has no volume";
  if (!(area > 0)) return std::string(kind) + " with an outline of one point has no volume";
  if (largest > largest_size || largest < smallest_size) {
    return std::string(kind) + " has an outline too small or too large to compute with; sizes go from 1e-60 to 1e60";
  }
  return {};
}

}  // namespace tenon
