#include "mesh/triangulate.h"

#include <algorithm>
#include <cmath>

namespace tenon {

namespace {

struct Point2 {
  double x, y;
};

double area(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A polygon seen along its normal, whose ears are cut off one by one.
class EarClipper {
 public:
  /// @param first  the corner that is tried first
  EarClipper(std::vector<Point2> points, std::size_t first)
      : points_(std::move(points)), ring_(points_.size()), first_(first) {
    for (std::size_t i = 0; i < ring_.size(); ++i) ring_[i] = i;
  }

  // emit(a, b, c) with places in the polygon.
  template <class Emit>
  void clip(Emit&& emit) {
    std::size_t i = first_, without_ear = 0;
    while (ring_.size() > 3) {
      // The best that can be done with a polygon that crosses itself is to cut somewhere; its solid will tell.
      const bool give_up = without_ear > ring_.size();
      if (give_up || is_ear(i)) {
        emit(ring_[before(i)], ring_[i], ring_[after(i)]);
        ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(i));
        i = i % ring_.size();
        without_ear = 0;
      } else {
        i = after(i);
        ++without_ear;
      }
    }
    emit(ring_[0], ring_[1], ring_[2]);
  }

 private:
  std::size_t before(std::size_t i) const { return i == 0 ? ring_.size() - 1 : i - 1; }
  std::size_t after(std::size_t i) const { return i + 1 == ring_.size() ? 0 : i + 1; }

  bool is_ear(std::size_t i) const {
    const Point2 &a = points_[ring_[before(i)]], &b = points_[ring_[i]], &c = points_[ring_[after(i)]];
    if (!(area(a, b, c) > 0)) return false;
    for (std::size_t k = 0; k < ring_.size(); ++k) {
      if (k == i || k == before(i) || k == after(i)) continue;
      const Point2& p = points_[ring_[k]];
      const bool is_corner = same(p, a) || same(p, b) || same(p, c);
      if (!is_corner && area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) return false;
    }
    return true;
  }
  static bool same(const Point2& a, const Point2& b) { return a.x == b.x && a.y == b.y; }

  std::vector<Point2> points_;
  std::vector<std::size_t> ring_;
  std::size_t first_;
};

}  // namespace

double triangulate(std::span<const std::uint32_t> corners, const std::vector<Vec3>& points,
                   std::vector<std::array<std::uint32_t, 3>>& out) {
  if (corners.size() == 3) {
    out.push_back({corners[0], corners[1], corners[2]});
    return 0;
  }
  // Newell's normal; the polygon is seen along its largest component.
  const Vec3 origin = points[corners[0]];
  Vec3 normal;
  double largest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = points[corners[i]], &b = points[corners[(i + 1) % corners.size()]];
    normal += cross(a - origin, b - origin);
    largest = std::max(largest, max_component(abs(a)));
  }
  const Vec3 n = normalize(normal);
  const Vec3 size = abs(n);
  const int along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int x = n[along] > 0 ? (along + 1) % 3 : (along + 2) % 3, y = 3 - along - x;
  std::vector<Point2> flat;
  double deviation = 0;
  for (const std::uint32_t corner : corners) {
    const Vec3& p = points[corner];
    flat.push_back({p[x], p[y]});
    deviation = std::max(deviation, std::fabs(dot(n, p - origin)));
  }
  // A quadrilateral may be bent: the shorter diagonal keeps nearer to it, as a rule.
  std::size_t first = 0;
  if (corners.size() == 4) {
    // Of two as long, that to the greatest corner: it does not depend on where the face begins.
    const auto length_of = [&](std::size_t i) { return length(points[corners[i + 2]] - points[corners[i]]); };
    const auto greatest = [&](std::size_t i) {
      const auto place = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
      return std::max(place(points[corners[i]]), place(points[corners[i + 2]]));
    };
    const double even = length_of(0), odd = length_of(1);
    first = even < odd || (even == odd && greatest(0) > greatest(1)) ? 1 : 0;
  }
  EarClipper(std::move(flat), first).clip([&](std::size_t a, std::size_t b, std::size_t c) {
    out.push_back({corners[a], corners[b], corners[c]});
  });
  return largest > 0 ? deviation / largest : 0;
}

}  // namespace tenon
