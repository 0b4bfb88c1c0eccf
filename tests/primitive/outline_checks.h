#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "primitive/arc.h"
#include "primitive/concept.h"
#include "primitive/outline_edges.h"
#include "primitive/random_placement.h"

/// Outlines to try, and what they are held against.
namespace tenon::outlines {

// A polygon around the origin whose radius jumps, with a hole of the same kind; corners on a coarse lattice now and
// then, so that edges run along the axes, and neighbours in line.
inline Outline random_outline(Random& random, bool with_arcs) {
  Outline outline;
  for (const double size : {2.0, 0.6}) {
    if (size < 1 && random.chance(0.5)) break;
    std::vector<OutlineCorner>& loop = outline.loops.emplace_back();
    const int corners = 3 + random.below(8);
    const bool on_lattice = random.chance(0.3);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * (i + random.uniform(0.1, 0.9)) / corners;
      const double r = size * random.uniform(0.5, 1);
      OutlineCorner corner{r * std::cos(angle), r * std::sin(angle), 0};
      if (on_lattice) corner = {std::round(4 * corner.x) / 4, std::round(4 * corner.y) / 4, 0};
      if (with_arcs && random.chance(0.4)) corner.bulge = random.uniform(-0.3, 0.3);
      loop.push_back(corner);
    }
    if (random.chance(0.5)) std::reverse(loop.begin(), loop.end());
  }
  return outline;
}

// How often a straight way in the plane crosses an edge, an arc being a hundred chords.
inline int crossings(const OutlineEdge& edge, const Vec2& a, const Vec2& b) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) { return cross(q - p, r - p) > 0; };
  const int parts = edge.is_arc() ? 100 : 1;
  // Of the sweep; it goes to the left where the bulge is positive, and the arc lies to the right of the chord.
  const double sweep = 4 * std::atan(edge.bulge);
  const Circle circle = edge.is_arc() ? circle_of_arc(edge.from, edge.to, edge.bulge) : Circle{};
  const Vec2 from = edge.from - circle.center;
  int count = 0;
  Vec2 last = edge.from;
  for (int i = 1; i <= parts; ++i) {
    const double angle = sweep * i / parts, c = std::cos(angle), s = std::sin(angle);
    const Vec2 next = i == parts ? edge.to : circle.center + Vec2{c * from.x - s * from.y, s * from.x + c * from.y};
    count += side(last, next, a) != side(last, next, b) && side(a, b, last) != side(a, b, next);
    last = next;
  }
  return count;
}

// What solids say that they come to within boxes (walls_within), held against what they say of points.
template <class Part>
struct WallParts {
  static constexpr std::size_t most_walls = 5;
  Part part;  // the last one
  int parts = 0, with_arcs = 0, crowded = 0, points = 0, inside = 0;

  // In a random box, around a place of the solid's frame, or turned against that. The way from the place that is known
  // tells of every point.
  // @param place_of  of the outline's plane, of a point of the box; nothing beyond the caps
  // @return the box, where there is a part
  template <class Solid, class PlaceOf>
  std::optional<LocalBox> check(const Solid& solid, const Vec3& around, double largest, Random& random,
                                const PlaceOf& place_of) {
    const Affine3 map =
        random.chance(0.5) ? Affine3::rotate({0, 0, 0}) : Affine3::rotate(90 * random.in_cube() + Vec3{10, 0, 0});
    const auto placement = Placement::create(BoundedAffine3::elementary(map), {0, 0, 0});
    const Vec3 middle = map.point(around), half = random.magnitude(-3, largest) * Vec3{1, random.uniform(0.3, 1), 1};
    const LocalBox box = placement->to_local(Box3{middle - half, middle + half});
    if (!solid.walls_within(box, most_walls, part)) return std::nullopt;
    EXPECT_LE(part.walls.size(), most_walls);
    ++parts;
    crowded += part.walls.size() > 2;
    with_arcs += std::any_of(part.walls.begin(), part.walls.end(), [](const OutlineEdge& w) { return w.is_arc(); });
    for (int i = 0; i < 20; ++i) {
      const Vec3 p = placement->point_to_local(middle + half * random.in_cube());
      const std::optional<Vec2> place = place_of(p);
      // Chords are that far from their arcs.
      const auto is_near = [&](const OutlineEdge& w) {
        return std::fabs(w.distance(*place - w.from)) < 1e-3 || std::fabs(w.distance(part.place - w.from)) < 1e-3;
      };
      if (place && std::any_of(part.walls.begin(), part.walls.end(), is_near)) continue;
      int passed = part.is_inside ? 1 : 0;
      for (const OutlineEdge& wall : part.walls) passed += place ? crossings(wall, part.place, *place) : 0;
      // By a box of no size.
      const Region region = solid.classify(placement->to_local(Box3{map.point(p), map.point(p)}));
      if (region == Region::straddles) continue;
      EXPECT_EQ(place && passed % 2 != 0, region == Region::inside) << "part " << parts << " point " << i;
      ++points;
      inside += region == Region::inside;
    }
    return box;
  }

  void expect_many() const {
    EXPECT_GT(parts, 10000);
    EXPECT_GT(with_arcs, 5000);
    EXPECT_GT(crowded, 800);
    EXPECT_GT(inside, points / 5);
    EXPECT_LT(inside, 4 * points / 5);
  }
};

// A corner of an outline.
inline const OutlineCorner& random_corner(const Outline& outline, Random& random) {
  const auto& loop = outline.loops[static_cast<std::size_t>(random.below(static_cast<int>(outline.loops.size())))];
  return loop[static_cast<std::size_t>(random.below(static_cast<int>(loop.size())))];
}

// What a solid says of each of a ray's crossings from its neighbourhood alone, against spans(), to the last bit.
struct NearbyCrossings {
  int asked = 0, found = 0;

  template <class Solid>
  void check(const Solid& solid, const LocalRay& ray, Random& random) {
    Spans spans;
    solid.spans(ray, spans);
    for (const Crossing& c : spans) {
      const double near = 1e-7;
      ++asked;
      const auto known = solid.crossing_near(ray, c.t + 0.5 * near * random.uniform(-1, 1), near, c.entering);
      if (!known) continue;
      ++found;
      EXPECT_EQ(known->t, c.t);
      EXPECT_EQ(known->face, c.face);
      EXPECT_EQ(known->entering, c.entering);
      EXPECT_GE(known->bound, c.bound);
    }
  }

  // The same for a ray that starts where this one meets the solid first.
  template <class Solid>
  void check_from_start(const Solid& solid, const LocalRay& ray, Random& random) {
    Spans spans;
    solid.spans(ray, spans);
    const auto start = std::find_if(spans.begin(), spans.end(), [](const Crossing& c) { return std::isfinite(c.t); });
    if (start == spans.end()) return;
    LocalRay next = ray;
    next.origin = ray.origin + start->t * ray.direction;
    next.origin_error = ray.origin_error + (start->bound + 0x1p-48) * (abs(ray.direction) + Vec3{1, 1, 1});
    next.direction = random.direction();
    next.on_face = static_cast<int>(start->face);
    check(solid, next, random);
  }
};

}  // namespace tenon::outlines
