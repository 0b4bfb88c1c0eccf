#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "tenon/accel/screen_view.h"
#include "tenon/math/box3.h"

namespace tenon {

/// The rectangles that boxes project to on the screen: a primary ray whose pixel lies outside cannot meet the box
/// (course, "Different kinds of bounding volumes").
class ScreenRectangles {
 public:
  /// @param margin  the enclosures' margin: what lies nearer than that to the eye's plane is not projected
  ScreenRectangles(const ScreenView& view, std::size_t count, double margin)
      : view_(view), margin_(margin), rectangles_(count) {}

  void set(std::size_t index, const Box3& box) {
    double left = HUGE_VAL, right = -HUGE_VAL, top = HUGE_VAL, bottom = -HUGE_VAL;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p{(corner & 1) != 0 ? box.upper.x : box.lower.x, (corner & 2) != 0 ? box.upper.y : box.lower.y,
                   (corner & 4) != 0 ? box.upper.z : box.lower.z};
      const Vec3 v = p - view_.eye;
      const double depth = view_.orthographic ? 1 : dot(view_.forward, v);
      if (!(depth > margin_)) {
        rectangles_[index] = {};
        return;
      }
      const double pixels = 0.5 * view_.width / (view_.half_width * depth);
      const double x = 0.5 * view_.width + dot(view_.right, v) * pixels;
      const double y = 0.5 * view_.height - dot(view_.up, v) * pixels;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = std::max(bottom, y);
    }
    // Beyond the eye's plane by the margin, 2^-32 of the scene, rounding moves a corner by less than 2^-16 of its
    // distance from the centre of the screen: less than a pixel on any screen.
    rectangles_[index] = {to_pixel(left) - 1, to_pixel(right) + 1, to_pixel(top) - 1, to_pixel(bottom) + 1};
  }

  /// One more, around a box.
  void add(const Box3& box) {
    rectangles_.emplace_back();
    set(rectangles_.size() - 1, box);
  }

  bool covers(std::size_t index, int x, int y) const {
    const Rectangle& r = rectangles_[index];
    return r.left <= x && x <= r.right && r.top <= y && y <= r.bottom;
  }
  std::size_t bytes() const { return rectangles_.size() * sizeof(Rectangle); }

 private:
  static constexpr int everywhere = 1 << 30;
  struct Rectangle {
    int left = -everywhere, right = everywhere, top = -everywhere, bottom = everywhere;
  };

  static int to_pixel(double x) {
    return static_cast<int>(std::clamp(std::floor(x), -0.5 * everywhere, 0.5 * everywhere));
  }

  ScreenView view_;
  double margin_;
  std::vector<Rectangle> rectangles_;
};

}  // namespace tenon
