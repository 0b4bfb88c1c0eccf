#include "plane/chords.h"

#include <cassert>
#include <numbers>

namespace tenon {

namespace {

// Clipper's coordinates keep well within a double, in which it finds intersections.
constexpr int grid_bits = 48;
// Beyond this radius, in the largest coordinate, the centre of an arc says nothing about the arc any more.
constexpr double farthest_center = 0x1p30;

}  // namespace

Chords::Chords(double largest)
    : unit_(std::ldexp(1, std::ilogb(largest) + 1 - grid_bits)),
      sagitta_(largest * 0x1p-15),
      largest_radius_(largest * farthest_center) {
  assert(largest > 0 && std::isfinite(largest));
}

ClipperLib::IntPoint Chords::to_grid(const Vec2& p) {
  const ClipperLib::IntPoint q(std::llround(p.x / unit_), std::llround(p.y / unit_));
  points_.try_emplace(q, p);
  return q;
}

Vec2 Chords::point(const ClipperLib::IntPoint& p) const {
  const auto known = points_.find(p);
  if (known != points_.end()) return known->second;
  return {static_cast<double>(p.X) * unit_, static_cast<double>(p.Y) * unit_};
}

// A power of two in a turn, so that all arcs of a circle share their points. The sagitta is r (1 - cos(step / 2)).
double Chords::step(const Circle& circle) const {
  const double widest = std::sqrt(8 * sagitta_ / circle.radius);
  double step = 2 * std::numbers::pi / fewest_chords;
  while (step > widest) step /= 2;
  return step;
}

double Chords::longest_chord(const Curve& curve) const {
  return curve.is_arc() ? step(curve.circle) * curve.circle.radius : 0;
}

// Corners on the arc, its beginning included, its end not.
void Chords::add_arc(const Curve& curve, std::vector<OutlineCorner>& loop) const {
  loop.push_back({curve.from.x, curve.from.y, 0});
  const auto [c, r] = curve.circle;
  const double width = step(curve.circle);
  const Vec2 start = curve.from - c;
  const double first = std::atan2(start.y, start.x) / width, last = first + 4 * std::atan(curve.bulge) / width;
  const double direction = curve.bulge > 0 ? 1 : -1;
  // A point all but at an end would make a chord without direction.
  constexpr double aside = 1e-3;
  double k = curve.bulge > 0 ? std::ceil(first + aside) : std::floor(first - aside);
  for (; direction * (last - k) > aside; k += direction) {
    const double angle = k * width;
    loop.push_back({c.x + r * std::cos(angle), c.y + r * std::sin(angle), 0});
  }
}

ClipperLib::Paths Chords::add(const Outline& outline) {
  ClipperLib::Paths paths;
  for (const auto& corners : outline.loops) {
    std::vector<OutlineCorner> loop;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const OutlineCorner &a = corners[i], &b = corners[(i + 1) % corners.size()];
      Curve curve{{a.x, a.y}, {b.x, b.y}, a.bulge, {}};
      if (curve.is_arc()) curve.circle = circle_of_arc(curve.from, curve.to, curve.bulge);
      // An arc of no curvature that a double could hold is straight.
      if (!(curve.circle.radius < largest_radius_)) curve.bulge = 0;
      if (curve.is_arc()) {
        add_arc(curve, loop);
      } else {
        loop.push_back({a.x, a.y, 0});
      }
      curve_of_chord_.resize(chord_count_ + loop.size(), curves_.size());
      curves_.push_back(curve);
    }
    chord_count_ += loop.size();
    ClipperLib::Path& path = paths.emplace_back();
    for (const OutlineCorner& corner : loop) path.push_back(to_grid({corner.x, corner.y}));
    chords_.loops.push_back(std::move(loop));
  }
  return paths;
}

Curve Chords::curve_of(const ClipperLib::IntPoint& from, const ClipperLib::IntPoint& to) const {
  const Vec2 a = point(from), b = point(to), middle = 0.5 * (a + b);
  const double near = same_place * unit_;
  const auto touches = [&](const Vec2& lower, const Vec2& upper) {
    return lower.x <= middle.x + near && middle.x - near <= upper.x && lower.y <= middle.y + near &&
           middle.y - near <= upper.y;
  };
  Curve best{a, b, 0, {}};
  double least = HUGE_VAL;
  edges_.visit_edges(touches, [&](std::uint32_t i) {
    const OutlineEdge& chord = edges_.edges()[i];
    const Vec2 w = chord.chord();
    const double off = std::max(std::fabs(cross(w, a - chord.from)), std::fabs(cross(w, b - chord.from)));
    const double distance = off / length(w);
    if (distance < least) least = distance, best = curves_[curve_of_chord_[i]];
    return true;
  });
  return best;
}

}  // namespace tenon
