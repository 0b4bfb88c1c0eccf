#include "plane/mapped_outline.h"

#include <algorithm>

#include "plane/arc_corners.h"
#include "plane/arc_fit.h"

namespace tenon {

namespace {

Vec2 image(const Affine3& map, const Vec2& p) {
  const Vec3 q = map.point({p.x, p.y, 0});
  return {q.x, q.y};
}

}  // namespace

bool keeps_circles(const Affine3& map) {
  const Vec2 a{map.m[0][0], map.m[1][0]}, b{map.m[0][1], map.m[1][1]};
  const double size = dot(a, a) + dot(b, b);
  // A rotation's sines and cosines are rounded, and multiplied a few times.
  constexpr double same = 0x1p-42;
  return std::fabs(dot(a, a) - dot(b, b)) <= same * size && std::fabs(dot(a, b)) <= same * size;
}

Outline mapped(const Outline& outline, const Affine3& map) {
  const bool round = keeps_circles(map);
  const double turn = map.m[0][0] * map.m[1][1] - map.m[0][1] * map.m[1][0] < 0 ? -1 : 1;
  Outline result;
  for (const auto& corners : outline.loops) {
    auto& loop = result.loops.emplace_back();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const OutlineCorner &a = corners[i], &b = corners[(i + 1) % corners.size()];
      const Vec2 from{a.x, a.y}, to{b.x, b.y};
      if (a.bulge == 0 || round) {
        const Vec2 p = image(map, from);
        loop.push_back({p.x, p.y, turn * a.bulge});
        continue;
      }
      const auto arc = arc_points(from, to, a.bulge);
      const Vec2 u{map.m[0][0], map.m[1][0]}, v{map.m[0][1], map.m[1][1]};
      const double radius = circle_of_arc(from, to, a.bulge).radius;
      fit_arcs([&](double t) { return image(map, arc(t)); }, 0, 1, 0x1p-20 * radius * std::max(length(u), length(v)),
               loop);
    }
  }
  return result;
}

}  // namespace tenon
