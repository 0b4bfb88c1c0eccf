#include "plane/offset.h"

#include <numbers>

#include "plane/clip.h"

namespace tenon {

namespace {

// Edges at a smaller angle, in radians, count as turning back: their miter would end on the far side of the world.
constexpr double least_angle = 0x1p-20;
// The angle between a chord and its arc is smaller (Chords).
constexpr double widest_step = 2 * std::numbers::pi / Chords::fewest_chords;

/// What an outline gains or loses: for every edge the band that it sweeps, and a join at every corner that opens.
class Bands {
 public:
  Bands(double distance, OffsetJoin join) : distance_(distance), join_(join) {}

  void add(const std::vector<OutlineCorner>& loop) {
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const OutlineCorner &a = loop[i], &b = loop[(i + 1) % n], &before = loop[(i + n - 1) % n];
      add_band({a.x, a.y}, {b.x, b.y}, a.bulge);
      add_join({a.x, a.y}, normal_at_end({before.x, before.y}, {a.x, a.y}, before.bulge),
               normal_at_start({a.x, a.y}, {b.x, b.y}, a.bulge));
    }
  }

  const std::vector<Outline>& pieces() const { return pieces_; }

 private:
  // Of length 1, to the right of the way from a to b.
  static Vec2 normal_at_start(const Vec2& a, const Vec2& b, double bulge) {
    const Vec2 w = b - a;
    // An arc sets out turned to the right of its chord by half of its angle: tan(half) = 2 bulge / (1 - bulge²).
    const double c = (1 - bulge) * (1 + bulge), s = -2 * bulge;
    const Vec2 way{c * w.x - s * w.y, s * w.x + c * w.y};
    return 1 / length(way) * Vec2{way.y, -way.x};
  }
  static Vec2 normal_at_end(const Vec2& a, const Vec2& b, double bulge) { return -1.0 * normal_at_start(b, a, -bulge); }

  void add_band(const Vec2& a, const Vec2& b, double bulge) {
    const Vec2 from = a + distance_ * normal_at_start(a, b, bulge), to = b + distance_ * normal_at_end(a, b, bulge);
    if (bulge == 0) return add_piece({{a.x, a.y, 0}, {b.x, b.y, 0}, {to.x, to.y, 0}, {from.x, from.y, 0}});
    const Circle circle = circle_of_arc(a, b, bulge);
    // Beyond the centre every point has a nearer one on the arc, or at its ends.
    const double radius = circle.radius + (bulge > 0 ? distance_ : -distance_);
    if (radius <= 0) return add_piece({{a.x, a.y, bulge}, {b.x, b.y, 0}, {circle.center.x, circle.center.y, 0}});
    add_piece({{a.x, a.y, bulge}, {b.x, b.y, 0}, {to.x, to.y, -bulge}, {from.x, from.y, 0}});
  }

  void add_join(const Vec2& at, const Vec2& n1, const Vec2& n2) {
    const double sine = cross(n1, n2), cosine = dot(n1, n2);
    const bool opens = sine * distance_ > 0;
    // Arcs that touch in a corner may cross in front of it by less than chords tell, and then seem to close it. Where
    // edges turn back a join does no harm on the side that closes: it lies within the shape.
    const bool turns_back = cosine < 0 && std::fabs(sine) <= (opens ? least_angle : widest_step);
    if (!opens && !turns_back) return;
    const Vec2 a = at + distance_ * n1, b = at + distance_ * n2;
    const double angle = turns_back ? std::copysign(std::numbers::pi, distance_) : std::atan2(sine, cosine);
    const double half = std::tan(angle / 2), quarter = std::tan(angle / 4);
    if (join_ == OffsetJoin::round) return add_piece({{at.x, at.y, 0}, {a.x, a.y, quarter}, {b.x, b.y, 0}});
    const Vec2 on1{-n1.y, n1.x}, on2{-n2.y, n2.x};  // along the edges
    const double ahead = std::fabs(distance_) * std::fabs(join_ == OffsetJoin::miter ? half : quarter);
    if (join_ == OffsetJoin::miter && !turns_back) {
      const Vec2 tip = a + ahead * on1;
      return add_piece({{at.x, at.y, 0}, {a.x, a.y, 0}, {tip.x, tip.y, 0}, {b.x, b.y, 0}});
    }
    const Vec2 c = a + ahead * on1, d = b - ahead * on2;
    add_piece({{at.x, at.y, 0}, {a.x, a.y, 0}, {c.x, c.y, 0}, {d.x, d.y, 0}, {b.x, b.y, 0}});
  }

  void add_piece(std::vector<OutlineCorner> loop) { pieces_.push_back({{std::move(loop)}}); }

  double distance_;
  OffsetJoin join_;
  std::vector<Outline> pieces_;
};

}  // namespace

Outline offset(const Outline& outline, double distance, OffsetJoin join) {
  if (distance == 0 || outline.loops.empty()) return outline;
  Bands bands(distance, join);
  for (const auto& loop : outline.loops) bands.add(loop);
  double largest = largest_coordinate(outline);
  for (const Outline& piece : bands.pieces()) largest = std::max(largest, largest_coordinate(piece));
  if (!has_grid(largest)) return {};
  Chords chords(largest);
  const ClipperLib::Paths shape = chords.add(outline);
  ClipperLib::Paths swept;
  for (const Outline& piece : bands.pieces()) {
    for (ClipperLib::Path& path : chords.add(piece)) {
      if (!ClipperLib::Orientation(path)) ClipperLib::ReversePath(path);
      swept.push_back(std::move(path));
    }
  }
  chords.index();
  return recover_outline(chords, clip(distance > 0 ? ClipperLib::ctUnion : ClipperLib::ctDifference, shape, swept));
}

}  // namespace tenon
