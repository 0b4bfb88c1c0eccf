#include "plane/contour.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "plane/arc_fit.h"

namespace tenon {

namespace {

constexpr int cells = 512;
// Where the boundary turns sharply its edges are halved so often.
constexpr int deepest = 14;

/// Marching squares, whose edges are then refined; arcs are put through their ends.
class ContourTracer {
 public:
  ContourTracer(const std::function<bool(const Vec2&)>& inside, const Vec2& lower, const Vec2& upper)
      : inside_(inside) {
    // The set does not reach the outermost nodes, and its straight edges seldom lie on others.
    const Vec2 size = upper - lower;
    step_ = 1.0 / (cells - 2.5) * size;
    origin_ = lower - 1.137 * step_;
    tolerance_ = 0x1p-17 * length(size);
    fit_tolerance_ = 0x1p-20 * length(size);
  }

  Outline trace() {
    for (int y = 0; y <= cells; ++y) {
      for (int x = 0; x <= cells; ++x) {
        const bool is_rim = x == 0 || y == 0 || x == cells || y == cells;
        states_[index(x, y)] = !is_rim && inside_(node(x, y));
      }
    }
    for (int y = 0; y < cells; ++y) {
      for (int x = 0; x < cells; ++x) add_cell(x, y);
    }
    Outline outline;
    while (!next_.empty()) {
      std::vector<Vec2> points;
      const std::uint64_t first = next_.begin()->first;
      const Vec2 start = boundary_of(first);
      Vec2 from = start;
      for (std::uint64_t at = first;;) {
        const auto found = next_.find(at);
        at = found->second;
        next_.erase(found);
        const Vec2 to = at == first ? start : boundary_of(at);
        refine(from, to, 0, points);
        from = to;
        if (at == first) break;
      }
      outline.loops.push_back(fit_arcs(points, fit_tolerance_));
    }
    return outline;
  }

 private:
  static std::size_t index(int x, int y) {
    return static_cast<std::size_t>(y) * (cells + 1) + static_cast<std::size_t>(x);
  }
  Vec2 node(double x, double y) const { return {origin_.x + x * step_.x, origin_.y + y * step_.y}; }
  bool state(int x, int y) const { return states_[index(x, y)]; }

  // An edge of the grid from a node to the right (0) or upward (1).
  static std::uint64_t edge(int x, int y, int way) { return 2 * index(x, y) + static_cast<std::uint64_t>(way); }

  // The boundary leaves a cell where, as one goes around it to the left, the set ends, and enters where it begins: so
  // that the set lies to the left of the boundary.
  void add_cell(int x, int y) {
    const std::array<bool, 4> corners{state(x, y), state(x + 1, y), state(x + 1, y + 1), state(x, y + 1)};
    const std::array<std::uint64_t, 4> sides{edge(x, y, 0), edge(x + 1, y, 1), edge(x, y + 1, 0), edge(x, y, 1)};
    std::array<int, 2> begins{}, ends{};
    int count = 0, end_count = 0;
    for (int i = 0; i < 4; ++i) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>((i + 1) % 4);
      if (!corners[a] && corners[b]) begins[static_cast<std::size_t>(count++)] = i;
      if (corners[a] && !corners[b]) ends[static_cast<std::size_t>(end_count++)] = i;
    }
    // Two parts in opposite corners are one where the middle is in the set.
    const bool joined = count == 2 && inside_(node(x + 0.5, y + 0.5));
    for (int i = 0; i < count; ++i) {
      // From where the set ends, back to where this part of it begins; or on to where the next one does.
      const int from = ends[static_cast<std::size_t>(i)];
      int to = begins[0];
      if (count == 2) {
        const int ahead = (begins[0] - from + 4) % 4 < (begins[1] - from + 4) % 4 ? 0 : 1;
        to = begins[static_cast<std::size_t>(joined ? ahead : 1 - ahead)];
      }
      next_[sides[static_cast<std::size_t>(from)]] = sides[static_cast<std::size_t>(to)];
    }
  }

  // Between a point of the set and one that is not.
  Vec2 boundary_between(Vec2 in, Vec2 out) const {
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
      const Vec2 middle = 0.5 * (in + out);
      (inside_(middle) ? in : out) = middle;
    }
    return 0.5 * (in + out);
  }

  Vec2 boundary_of(std::uint64_t id) const {
    const int at = static_cast<int>(id / 2), x = at % (cells + 1), y = at / (cells + 1);
    const Vec2 a = node(x, y), b = id % 2 == 0 ? node(x + 1, y) : node(x, y + 1);
    return state(x, y) ? boundary_between(a, b) : boundary_between(b, a);
  }

  // Adds the way from a to b, its end left out.
  void refine(const Vec2& a, const Vec2& b, int depth, std::vector<Vec2>& points) const {
    const Vec2 w = b - a;
    if (depth < deepest && length(w) > tolerance_) {
      const Vec2 middle = 0.5 * (a + b), left{-w.y, w.x};
      // Mostly the edge itself is near enough.
      const Vec2 aside = tolerance_ / length(w) * left;
      if (!inside_(middle + aside) || inside_(middle - aside)) {
        if (inside_(middle + left) && !inside_(middle - left)) {
          const Vec2 m = boundary_between(middle + left, middle - left);
          refine(a, m, depth + 1, points);
          refine(m, b, depth + 1, points);
          return;
        }
      }
    }
    points.push_back(a);
  }

  const std::function<bool(const Vec2&)>& inside_;
  Vec2 origin_, step_;
  double tolerance_ = 0, fit_tolerance_ = 0;  // of edges, and of arcs through points of the boundary
  std::vector<bool> states_ = std::vector<bool>((cells + 1) * (cells + 1));
  std::map<std::uint64_t, std::uint64_t> next_;  // from side to side through each cell
};

}  // namespace

Outline contour(const std::function<bool(const Vec2&)>& inside, const Vec2& lower, const Vec2& upper) {
  return ContourTracer(inside, lower, upper).trace();
}

}  // namespace tenon
