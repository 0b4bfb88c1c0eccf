#pragma once

#include <algorithm>
#include <cmath>

#include "support/random.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// Loops of all shapes: stars of segments and arcs, holes, circles, slots whose arcs leave their segments smoothly,
/// and loops that cross themselves and one another.
class RandomOutline {
 public:
  RandomOutline(Random& random, double size) : random_(random), size_(size) {}

  Outline draw() {
    Outline outline;
    const double x = size_ * random_.uniform(-1, 2), y = size_ * random_.uniform(-1, 1);
    for (int i = random_.below(6); i >= 0; i -= 3) add_loop(outline, x, y, i == 0 ? 1 : 0.4);
    return outline;
  }

 private:
  void add_loop(Outline& outline, double x, double y, double factor) {
    auto& loop = outline.loops.emplace_back();
    const double r = factor * size_;
    switch (random_.below(5)) {
      case 0:
        loop = {{x + r, y, 1}, {x - r, y, 1}};
        break;
      case 1: {
        const double length = r * random_.uniform(0.2, 1), half = r * random_.uniform(0.1, 0.6);
        loop = {
            {x - length, y - half, 0}, {x + length, y - half, 1}, {x + length, y + half, 0}, {x - length, y + half, 1}};
        break;
      }
      case 2:
        for (int n = 3 + random_.below(6), i = 0; i < n; ++i) {
          const double dx = random_.uniform(-r, r), dy = random_.uniform(-r, r);
          loop.push_back({x + dx, y + dy, random_.chance(0.7) ? 0 : random_.uniform(-1.5, 1.5)});
        }
        break;
      default:
        for (int n = 3 + random_.below(8), i = 0; i < n; ++i) {
          const double angle = 2 * 3.14159265358979 * i / n, d = r * random_.uniform(0.4, 1);
          const double bulge = random_.chance(0.6) ? 0 : random_.uniform(-0.4, 0.4);
          loop.push_back({x + d * std::cos(angle), y + d * std::sin(angle), bulge});
        }
    }
    if (random_.chance(0.3)) std::reverse(loop.begin(), loop.end());
  }

  Random& random_;
  double size_;
};

}  // namespace tenon
