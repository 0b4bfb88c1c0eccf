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
  Vec2 at(double share) const { return from + share * along; }
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
    }
    const Vec2 place = clear_point();
    if (!(clearance(place) > slip_)) return std::nullopt;
    if (count_ == 1) walls_[0].side = edges_.contains(place) == (walls_[0].distance(place) > 0) ? 1 : -1;
    Wedge wedge;
    std::optional<Vec2> between;
    for (std::size_t i = 0; i < count_; ++i) {
      const Stretch stretch = rest_of_line(i);
      if (!is_covered(i, stretch)) return std::nullopt;
      if (!stretch.is_empty()) between = between_walls(walls_[i].at(0.5 * (stretch.first + stretch.last)), between);
      const Vec2 outward = -walls_[i].side * walls_[i].right;
      wedge.sides[i] = {outward, dot(outward, walls_[i].from)};
    }
    // Whether the outline means it so, a place between all walls tells, and one beyond each: where walls lie on one
    // another, it bounds nothing there. What of the box is beyond a wall no other enters, and it has the corner that
    // lies farthest.
    if (!between) return std::nullopt;
    wedge.is_solid = edges_.contains(*between);
    for (std::size_t i = 0; i < count_; ++i) {
      const Vec2 corner = farthest_corner(wedge.sides[i].normal);
      const bool is_beyond = dot(wedge.sides[i].normal, corner) - wedge.sides[i].d > 2 * slip_;
      if (is_beyond && edges_.contains(corner) == wedge.is_solid) return std::nullopt;
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

  /// A part of a wall's line, in lengths of the wall.
  struct Stretch {
    double first, last;
    bool is_empty() const { return !(first <= last); }
  };

  // What the other half-planes and the box leave of a wall's line.
  Stretch rest_of_line(std::size_t i) const {
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
    return {first, last};
  }

  // Whether that belongs to the wall.
  bool is_covered(std::size_t i, const Stretch& stretch) const {
    const double slip = 4 * slip_ / walls_[i].length;
    return stretch.is_empty() || (stretch.first >= -slip && stretch.last <= 1 + slip);
  }

  // How far a place lies within all half-planes.
  double depth(const Vec2& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) least = std::min(least, walls_[i].side * walls_[i].distance(p));
    return least;
  }

  // A place between all walls, the deepest of some: those on the way from one on a wall to the points of clear_point(),
  // and to the last that was found.
  std::optional<Vec2> between_walls(const Vec2& on_wall, std::optional<Vec2> best) const {
    double most = best ? depth(*best) : 2 * slip_;
    const auto try_towards = [&](const Vec2& p) {
      for (const double share : {0.5, 0.0625, 1.0}) {
        const Vec2 q = on_wall + share * (p - on_wall);
        if (!(depth(q) > most) || !is_in_box(q)) continue;
        most = depth(q);
        best = q;
      }
    };
    for_each_sample(try_towards);
    for (std::size_t i = 0; i < count_; ++i) {
      const Stretch stretch = rest_of_line(i);
      if (!stretch.is_empty()) try_towards(walls_[i].at(0.5 * (stretch.first + stretch.last)));
    }
    return best;
  }

  // Within the box as seen along z. Its bounds, which walls are cut by, reach further where it is turned.
  bool is_in_box(const Vec2& p) const {
    return std::ranges::all_of(box_.half_edges, [&](const Vec3& side) {
      const Vec2 across{-side.y, side.x};
      double reach = 0;
      for (const Vec3& edge : box_.half_edges) reach += std::fabs(dot(across, {edge.x, edge.y}));
      return std::fabs(dot(across, p - Vec2{box_.center.x, box_.center.y})) <= reach;
    });
  }

  Vec2 farthest_corner(const Vec2& n) const {
    Vec2 best;
    double most = -std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = box_.corner(corner);
      if (dot(n, {p.x, p.y}) <= most) continue;
      most = dot(n, {p.x, p.y});
      best = {p.x, p.y};
    }
    return best;
  }

  template <class Take>
  void for_each_sample(const Take& take) const {
    take(Vec2{box_.center.x, box_.center.y});
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 halfway = 0.5 * (box_.center + box_.corner(corner));
      take(Vec2{halfway.x, halfway.y});
    }
  }

  // Of a few points of the box, the one that is farthest from all lines.
  Vec2 clear_point() const {
    Vec2 best;
    double most = -1;
    for_each_sample([&](const Vec2& p) {
      if (clearance(p) <= most) return;
      most = clearance(p);
      best = p;
    });
    return best;
  }
  double clearance(const Vec2& p) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) least = std::min(least, std::fabs(walls_[i].distance(p)));
    return least;
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
