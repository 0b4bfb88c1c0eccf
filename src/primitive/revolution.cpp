#include "primitive/revolution.h"

#include <algorithm>
#include <cmath>

#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/revolution_line.h"
#include "tenon/math/rounding.h"

namespace tenon {

std::string Revolution::check() const {
  if (std::string problem = check_outline(name, outline); !problem.empty()) return problem;
  // A circle that touches the axis may reach over it by the rounding of its box.
  const Vec2 reach = edges_.reach();
  if (edges_.lower().x < -gamma(64) * (reach.x + reach.y)) {
    return "revolution has an outline that reaches over the axis; keep the distances at least 0";
  }
  if (!(edges_.upper().x > 0)) return "revolution has an outline without distance from the axis, and no volume";
  return {};
}

void Revolution::spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const {
  Line line(ray, edges_);
  if (!line.find_part(edges_)) return;
  const SearchedPart part = SearchedPart{line.begin(), line.end(), true, true}.within(window);
  if (part.is_empty()) return;
  thread_local std::vector<EdgeCrossing> crossings;
  thread_local std::vector<BoundaryCrossing> boundary;
  line.cross_edges(edges_, window, crossings);
  const auto is_inside = [&](double t) { return line.lies_in_segment(t) || edges_.contains(line.at(t)); };
  bool inside = find_boundary_crossings(crossings, part, is_inside, boundary);
  const std::size_t first = out.size();
  End enter = Chord().enter;
  for (const BoundaryCrossing& c : boundary) {
    if (c.entering) {
      enter = c.end;
    } else {
      emit_chord({enter, c.end}, out);
    }
    inside = c.entering;
  }
  if (inside) emit_chord({enter, Chord().leave}, out);
  put_in_order(first, out);
}

std::optional<Crossing> Revolution::crossing_near(const LocalRay& ray, double t, double near, bool entering) const {
  Line line(ray, edges_);
  if (!line.find_part(edges_)) return std::nullopt;
  // Whatever may be one with a crossing there, if that is known to within `near`.
  const double first = t - 2 * near, last = t + 2 * near;
  thread_local std::vector<EdgeCrossing> crossings;
  line.cross_edges(edges_, {first, last}, crossings);
  if (crossings.size() != 1) return std::nullopt;
  const EdgeCrossing& wall = crossings.front();
  const bool is_known = wall.sure && !wall.given && wall.lo >= first && wall.hi <= last;
  if (!is_known || std::fabs(wall.t - t) > near) return std::nullopt;
  return crossing_at({{wall.t, wall.lo, wall.hi}, face_of_edge(wall.edge, wall.rising, entering)}, entering);
}

/// The part of the outline's half-plane that a box goes through.
///
/// With u the direction from the axis to the box's middle and v across it, the distance from the axis changes over the
/// box as along u, and by at most the square of the way along v over twice the least distance more.
class Revolution::MeridianBox {
 public:
  explicit MeridianBox(const LocalBox& box) : box_(box) {
    const Vec3& c = box.center;
    const double middle = std::sqrt(c.x * c.x + c.y * c.y);
    u_ = middle > 0 ? Vec3{c.x / middle, c.y / middle, 0} : Vec3{1, 0, 0};
    const Extent radial = extent_along(box, u_), sideways = extent_along(box, {-u_.y, u_.x, 0});
    const double aside = std::fabs(sideways.center) + sideways.radius;
    const double rounding = gamma(16) * (reach(box).x + reach(box).y);
    const double least = radial.least() - rounding,
                 most = std::max(std::fabs(radial.greatest()), std::fabs(radial.least())) + rounding;
    lower_ = {std::max(least, 0.0), box.bounds.lower.z};
    upper_ = {std::sqrt(most * most + aside * aside) * (1 + gamma(4)), box.bounds.upper.z};
    place_ = {middle, c.z};
    bend_ = least > 0 ? 0.5 * aside * aside / least : HUGE_VAL;
  }

  /// Of the box's middle.
  const Vec2& place() const { return place_; }
  /// Whether a rectangle around it meets another.
  bool overlaps(const Vec2& lower, const Vec2& upper) const {
    return lower.x <= upper_.x && lower_.x <= upper.x && lower.y <= upper_.y && lower_.y <= upper.y;
  }

  /// Which side of an edge's line or circle all of it lies on: the sign of q; 0 where it may touch.
  int side_of(const OutlineEdge& edge) const {
    const Vec2 p = place_ - edge.from, n = edge.normal(p);
    const Vec3 slope = n.x * u_ + Vec3{0, 0, n.y};
    double first_order = dot(abs(slope), box_.error), away = length(box_.error);
    for (const Vec3& half_edge : box_.half_edges) {
      first_order += std::fabs(dot(slope, half_edge));
      away += length(half_edge);
    }
    const double size = length(p) + away + length(edge.from);
    const double change = first_order + std::fabs(edge.bulge) * away * away + std::fabs(n.x) * bend_ +
                          gamma(32) * size * (edge.steepness(size) + std::fabs(edge.bulge) * size);
    const double value = edge.value(p);
    if (!(std::fabs(value) > change * (1 + gamma(8)))) return 0;
    return value > 0 ? 1 : -1;
  }

 private:
  const LocalBox& box_;
  Vec3 u_;
  Vec2 lower_, upper_, place_;
  double bend_;
};

Region Revolution::classify(const LocalBox& box) const {
  const MeridianBox image(box);
  const auto overlaps = [&](const Vec2& a, const Vec2& b) { return image.overlaps(a, b); };
  const bool clear =
      edges_.visit_edges(overlaps, [&](std::uint32_t i) { return image.side_of(edges_.edges()[i]) != 0; });
  if (!clear) return Region::straddles;
  return edges_.contains(image.place()) ? Region::inside : Region::outside;
}

// Ways between places of the image may leave it, but not the half-planes and discs that it lies in.
bool Revolution::walls_within(const LocalBox& box, std::size_t most, RevolvedPart& part) const {
  part.walls.clear();
  const MeridianBox image(box);
  const auto overlaps = [&](const Vec2& a, const Vec2& b) { return image.overlaps(a, b); };
  const bool are_few = edges_.visit_edges(overlaps, [&](std::uint32_t i) {
    const OutlineEdge& edge = edges_.edges()[i];
    if (edge.is_arc() ? image.side_of(edge) * edge.bulge < 0 : image.side_of(edge) != 0) return true;
    // What lies on the axis bounds nothing.
    if (edge.from.x <= 0 && edge.to.x <= 0 && !edge.is_arc()) return true;
    if (part.walls.size() == most) return false;
    part.walls.push_back({edge, i});
    return true;
  });
  if (!are_few) return false;
  part.choose_place(box, edges_, [](const Vec3& p) { return Vec2{std::hypot(p.x, p.y), p.z}; });
  return true;
}

Vec3 Revolution::normal(const Vec3& point, std::uint32_t face) const {
  const OutlineEdge& edge = edges_.edges()[face / 2];
  const double across = std::sqrt(point.x * point.x + point.y * point.y);
  const Vec2 n = edge.normal(Vec2{across, point.z} - edge.from);
  Vec3 outward{0, 0, n.y};
  if (across > 0) outward += n.x / across * Vec3{point.x, point.y, 0};
  if (outward == Vec3{}) outward.z = 1;
  return face % 2 == 0 ? outward : -outward;
}

}  // namespace tenon
