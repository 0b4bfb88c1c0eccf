#pragma once

#include <cmath>

#include "tenon/accel/screen_view.h"
#include "tenon/math/box3.h"
#include "tenon/math/ray.h"

namespace tenon {

/// RR-612's spherical enclosure (§3.3), which filters the rays that do not come from the eye.
struct EnclosingSphere {
  Vec3 center;
  double radius_squared = 0;

  EnclosingSphere() = default;
  /// Around a box, grown by `margin`, which covers the rounding of missed_by(): 2^-51 of the distance of the origin.
  EnclosingSphere(const Box3& box, double margin) : center(box.center()) {
    const double radius = length(box.size()) / 2 + margin;
    radius_squared = radius * radius;
  }

  /// Whether the ray's line passes outside. The distance is taken from the cross product, not as a difference of
  /// squares, which would cancel for an origin far away.
  bool missed_by(const Ray& ray) const {
    const Vec3 n = cross(center - ray.origin, ray.direction);
    return dot(n, n) > radius_squared * dot(ray.direction, ray.direction);
  }
};

/// The enclosing rectangle on the screen (RR-612 §4.3), which filters primary rays: pixels, ends included.
struct EnclosingRectangle {
  int left, top, right, bottom;

  static EnclosingRectangle whole_screen(const ScreenView& view) { return {0, 0, view.width - 1, view.height - 1}; }

  bool holds(int x, int y) const { return left <= x && x <= right && top <= y && y <= bottom; }
};

/// The rectangle around points seen in a view.
class RectangleOnScreen {
 public:
  explicit RectangleOnScreen(const ScreenView& view) : view_(view) {}

  void add(const Vec3& world) {
    const Vec3 p = world - view_.eye;
    const double depth = dot(p, view_.forward);
    // What lies beside or behind the eye has no place on the screen. 2^-20 of the distance keeps the rounding of the
    // depth, 2^-51 of the distance, so small that the place is right to 2^-31 of itself: far below a pixel.
    if (!view_.orthographic && !(depth > 0x1p-20 * length(p))) {
      around_the_eye_ = true;
      return;
    }
    const double scale = view_.width / (2 * view_.half_width * (view_.orthographic ? 1 : depth));
    const double x = 0.5 * view_.width + scale * dot(p, view_.right);
    const double y = 0.5 * view_.height - scale * dot(p, view_.up);
    bounds_ = hull(bounds_, Vec3{x, y, 0});
  }

  /// One pixel wider on each side than the points are, so that no rounding matters.
  EnclosingRectangle rectangle() const {
    if (around_the_eye_) return EnclosingRectangle::whole_screen(view_);
    return {pixel(bounds_.lower.x - 1, view_.width), pixel(bounds_.lower.y - 1, view_.height),
            pixel(bounds_.upper.x + 1, view_.width), pixel(bounds_.upper.y + 1, view_.height)};
  }

 private:
  // -1 and `count` stand for everything beyond the screen's edges.
  static int pixel(double x, int count) {
    if (!(x > -1)) return -1;
    return x < count ? static_cast<int>(std::floor(x)) : count;
  }

  ScreenView view_;
  Box3 bounds_;
  bool around_the_eye_ = false;
};

}  // namespace tenon
