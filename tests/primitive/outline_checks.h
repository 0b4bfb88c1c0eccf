#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

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
};

}  // namespace tenon::outlines
