#include "plane/line_crossings.h"

#include <algorithm>

#include "primitive/arc.h"

namespace tenon {

namespace {

/// Whether a point of an arc's circle lies on the arc: seen from the chord, on the side to which it bulges.
bool is_on_arc(const Vec2& from, const Vec2& to, double bulge, const Vec2& p) {
  return cross(to - from, p - from) * bulge < 0;
}

class LineCrossings {
 public:
  LineCrossings(const PlaneLine& line, double same_place) : line_(line), same_place_(same_place) {}

  void add(const Vec2& a, const Vec2& b, double bulge) {
    const bool from_before = is_before(a), to_before = is_before(b);
    if (bulge == 0) {
      if (from_before == to_before) return;
      const double from = line_.side(a), to = line_.side(b), share = from / (from - to);
      positions_.push_back(dot(line_.along(), a) + share * dot(line_.along(), b - a));
      return;
    }
    const Circle circle = circle_of_arc(a, b, bulge);
    const double off = line_.side(circle.center), middle = dot(line_.along(), circle.center);
    const double half = std::sqrt(std::max(0.0, (circle.radius - off) * (circle.radius + off)));
    if (from_before != to_before) {
      // Around to the left the circle comes to the far side of the line where its positions are less, and comes back
      // where they are greater.
      const bool is_less = (bulge > 0) == to_before;
      positions_.push_back(is_less ? middle - half : middle + half);
      return;
    }
    // Both ends are on one side; so the arc crosses twice if it reaches the other.
    const Vec2 furthest = circle.center + (from_before ? -circle.radius : circle.radius) * line_.normal;
    if (is_before(furthest) == from_before || !is_on_arc(a, b, bulge, furthest)) return;
    positions_.push_back(middle - half);
    positions_.push_back(middle + half);
  }

  std::vector<double> sorted() && {
    std::sort(positions_.begin(), positions_.end());
    return std::move(positions_);
  }

 private:
  bool is_before(const Vec2& p) const { return line_.side(p) > same_place_; }

  const PlaneLine& line_;
  const double same_place_;
  std::vector<double> positions_;
};

}  // namespace

std::vector<double> line_crossings(const Outline& outline, const PlaneLine& line, double same_place) {
  LineCrossings crossings(line, same_place);
  for (const auto& loop : outline.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
      crossings.add({a.x, a.y}, {b.x, b.y}, a.bulge);
    }
  }
  return std::move(crossings).sorted();
}

}  // namespace tenon
