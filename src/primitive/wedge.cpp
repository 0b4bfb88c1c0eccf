#include "primitive/wedge.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace tenon {

namespace {

/// A straight edge and the side of its line on which the wedge lies.
struct Wall {
  Vec2 from, along;  ///< along is the whole edge
  double length = 0;
  Vec2 right;    ///< of length 1
  int side = 0;  ///< 1: to the right, -1: to the left, 0: not known yet

  double distance(const Vec2& p) const { return dot(right, p - from); }
};

class WedgeSearch {
 public:
  WedgeSearch(const OutlineEdges& edges, std::span<const std::uint32_t> numbers, const LocalBox& box)
      : edges_(edges), box_(box), count_(numbers.size()) {
    for (std::size_t i = 0; i < count_; ++i) {
      const OutlineEdge& edge = edges.edges()[numbers[i]];
      const Vec2 w = edge.chord();
      const double size = length(w);
      walls_[i] = {edge.from, w, size, {w.y / size, -w.x / size}, 0};
    }
    lower_ = {box.bounds.lower.x, box.bounds.lower.y};
    upper_ = {box.bounds.upper.x, box.bounds.upper.y};
    // Well above what the arithmetic here rounds: some twenty roundings of products of coordinates. Who uses the planes
    // lets no more than 2^39 times this be an error of place (PlanesRecorder: a plane's own error is 2^-49 of the
    // coordinates, and at most 2^-10 of what crossings are told apart by), so it is 2^-5 of that at most.
    const Vec2 reach = max(edges.reach(), max(abs(lower_), abs(upper_)));
    slip_ = 0x1p-44 * length(reach);
  }

  std::optional<Wedge> find() {
    for (std::size_t i = 0; i < count_; ++i) {
      if (!(walls_[i].length > 0) || (count_ > 1 && !find_side(walls_[i]))) return std::nullopt;
      for (std::size_t k = 0; k < i; ++k) {
        if (lies_along(walls_[k], walls_[i])) return std::nullopt;
      }
    }
    const Vec2 place = clear_point();
    if (!(clearance(place) > slip_)) return std::nullopt;
    const bool is_inside = edges_.contains(place);
    if (count_ == 1) walls_[0].side = is_inside == (walls_[0].distance(place) > 0) ? 1 : -1;
    Wedge wedge;
    wedge.is_solid = is_inside == is_within(place);
    for (std::size_t i = 0; i < count_; ++i) {
      if (!covers_its_line(i)) return std::nullopt;
      const Vec2 outward = -walls_[i].side * walls_[i].right;
      wedge.sides[i] = {outward, dot(outward, walls_[i].from)};
    }
    return wedge;
  }

 private:
  // The side on which all other walls lie.
  bool find_side(Wall& wall) const {
    double least = 0, most = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      for (const Vec2& end : {walls_[i].from, walls_[i].from + walls_[i].along}) {
        if (&walls_[i] == &wall) continue;
        least = std::min(least, wall.distance(end));
        most = std::max(most, wall.distance(end));
      }
    }
    if (least < -slip_ && most > slip_) return false;
    wall.side = most > slip_ ? 1 : least < -slip_ ? -1 : 0;
    return wall.side != 0;
  }

  // Whether a wall lies on the line of another. If both covered what the box has of it, the outline would go there and
  // back, and bound nothing.
  bool lies_along(const Wall& wall, const Wall& line) const {
    const Vec2 end = wall.from + wall.along;
    return std::fabs(line.distance(wall.from)) <= slip_ && std::fabs(line.distance(end)) <= slip_;
  }

  // Whether what the other half-planes and the box leave of a wall's line belongs to the wall.
  bool covers_its_line(std::size_t i) const {
    const Wall& wall = walls_[i];
    double first = -std::numeric_limits<double>::infinity(), last = -first;
    // value + s slope >= 0 for the parts of the whole edge, s
    const auto clip = [&](double value, double slope) {
      if (slope > 0) {
        first = std::max(first, -value / slope);
      } else if (slope < 0) {
        last = std::min(last, -value / slope);
      } else if (value < -slip_) {
        last = -std::numeric_limits<double>::infinity();
      }
    };
    clip(wall.from.x - lower_.x, wall.along.x);
    clip(upper_.x - wall.from.x, -wall.along.x);
    clip(wall.from.y - lower_.y, wall.along.y);
    clip(upper_.y - wall.from.y, -wall.along.y);
    for (std::size_t k = 0; k < count_; ++k) {
      if (k == i) continue;
      const Wall& other = walls_[k];
      clip(other.side * other.distance(wall.from), other.side * dot(other.right, wall.along));
    }
    const double slip = 4 * slip_ / wall.length;
    return !(first <= last) || (first >= -slip && last <= 1 + slip);
  }

  // Of a few points of the box, the one that is farthest from all lines.
  Vec2 clear_point() const {
    Vec2 best{box_.center.x, box_.center.y};
    double most = clearance(best);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 halfway = 0.5 * (box_.center + box_.corner(corner));
      const Vec2 p{halfway.x, halfway.y};
      if (clearance(p) <= most) continue;
      most = clearance(p);
      best = p;
    }
    return best;
  }
  double clearance(const Vec2& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) least = std::min(least, std::fabs(walls_[i].distance(p)));
    return least;
  }
  bool is_within(const Vec2& p) const {
    return std::all_of(walls_.begin(), walls_.begin() + static_cast<std::ptrdiff_t>(count_),
                       [&](const Wall& wall) { return wall.side * wall.distance(p) > 0; });
  }

  const OutlineEdges& edges_;
  const LocalBox& box_;
  const std::size_t count_;
  std::array<Wall, 4> walls_;
  Vec2 lower_, upper_;
  double slip_;
};

}  // namespace

std::optional<Wedge> find_wedge(const OutlineEdges& edges, std::span<const std::uint32_t> walls, const LocalBox& box) {
  assert(!walls.empty() && walls.size() <= 4);
  return WedgeSearch(edges, walls, box).find();
}

}  // namespace tenon
