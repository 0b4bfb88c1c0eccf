#include "mesh/triangle_pair.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "math/orientation.h"

namespace tenon {

namespace {

Vec3 mean(std::span<const Vec3> points) {
  return std::accumulate(points.begin(), points.end(), Vec3{}) / static_cast<double>(points.size());
}

// Whether the line through an edge of a, turning as `turn` says, has all of these points on it or beyond.
bool has_all_beyond(const Vec3& from, const Vec3& to, int turn, std::span<const Vec3> points, const FlatView& view) {
  return std::all_of(points.begin(), points.end(), [&](const Vec3& p) { return view.turn(from, to, p) != turn; });
}

bool edge_separates(const Triangle& t, std::span<const Vec3> points, const FlatView& view) {
  const int turn = view.turn(t[0], t[1], t[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    if (has_all_beyond(t[i], t[(i + 1) % 3], turn, points, view)) return true;
  }
  return false;
}

bool edge_keeps_apart(const Triangle& t, const Triangle& other, const FlatView& view) {
  const int turn = view.turn(t[0], t[1], t[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    int within = 0, on_line = 0;
    for (const Vec3& p : other) {
      const int side = view.turn(t[i], t[(i + 1) % 3], p);
      within += side == turn;
      on_line += side == 0;
    }
    if (within == 0 && on_line <= 1) return true;
  }
  return false;
}

// Turns the corners so that the first is alone on its side of the other triangle's plane.
// @return its side
int put_lone_corner_first(Triangle& t, Sides sides) {
  for (int i = 0; i < 3; ++i) {
    if (sides[0] != 0 && sides[1] != sides[0] && sides[2] != sides[0]) break;
    std::rotate(t.begin(), t.begin() + 1, t.end());
    std::rotate(sides.begin(), sides.begin() + 1, sides.end());
  }
  return sides[0];
}

bool has_both(const Sides& sides) {
  return std::find(sides.begin(), sides.end(), 1) != sides.end() &&
         std::find(sides.begin(), sides.end(), -1) != sides.end();
}

}  // namespace

std::optional<FlatView> FlatView::of(const Triangle& t) {
  const Vec3 n = abs(cross(t[1] - t[0], t[2] - t[0]));
  std::array<int, 3> axes{0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&n](int i, int j) { return n[i] > n[j]; });
  for (const int axis : axes) {
    FlatView view;
    view.across_ = {(axis + 1) % 3, (axis + 2) % 3};
    if (view.turn(t[0], t[1], t[2]) != 0) return view;
  }
  return std::nullopt;
}

int FlatView::turn(const Vec3& a, const Vec3& b, const Vec3& c) const {
  return orientation((*this)(a), (*this)(b), (*this)(c));
}

bool pass_through(const Triangle& a, const Triangle& b, const Sides& of_b, const Sides& of_a) {
  if (!has_both(of_a) || !has_both(of_b)) return false;
  Triangle p = a, q = b;
  const int p_side = put_lone_corner_first(p, of_a), q_side = put_lone_corner_first(q, of_b);
  // So that each lone corner lies where the other's normal points.
  if (p_side < 0) std::swap(q[1], q[2]);
  if (q_side < 0) std::swap(p[1], p[2]);
  // On the line that both planes have in common each triangle has an interval; each begins before the other ends.
  return orientation(p[0], p[1], q[0], q[1]) > 0 && orientation(p[0], p[2], q[2], q[0]) > 0;
}

bool are_apart(const Triangle& a, const Triangle& b, const FlatView& view) {
  return edge_keeps_apart(a, b, view) || edge_keeps_apart(b, a, view);
}

bool overlap(const Triangle& a, const Triangle& b, const FlatView& view) {
  return !edge_separates(a, b, view) && !edge_separates(b, a, view);
}

bool runs_inside(const Segment& s, const Triangle& t, const FlatView& view) {
  bool left = false, right = false;
  for (const Vec3& p : t) {
    const int turn = view.turn(s[0], s[1], p);
    left |= turn > 0;
    right |= turn < 0;
  }
  return left && right && !edge_separates(t, s, view);
}

bool run_along(const Segment& a, const Segment& b, const FlatView& view) {
  if (view.turn(a[0], a[1], b[0]) != 0 || view.turn(a[0], a[1], b[1]) != 0) return false;
  const Vec3 size = abs(a[1] - a[0]);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  return std::max(min(a[0], a[1])[axis], min(b[0], b[1])[axis]) <
         std::min(max(a[0], a[1])[axis], max(b[0], b[1])[axis]);
}

Vec3 common_place(std::span<const Vec3> polygon, const Triangle& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  std::vector<Vec3> rest(polygon.begin(), polygon.end());
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const Vec3 inward = cross(n, t[(edge + 1) % 3] - t[edge]);
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const Vec3 &from = rest[i], &to = rest[(i + 1) % rest.size()];
      const double here = dot(inward, from - t[edge]), there = dot(inward, to - t[edge]);
      if (here >= 0) kept.push_back(from);
      if ((here < 0) != (there < 0)) kept.push_back(from + here / (here - there) * (to - from));
    }
    // Rounding may leave nothing of very little.
    if (kept.empty()) break;
    rest = std::move(kept);
  }
  return mean(rest);
}

Vec3 common_place(const Triangle& a, const Triangle& b) {
  const Vec3 n = cross(a[1] - a[0], a[2] - a[0]);
  std::vector<Vec3> in_plane;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &from = b[i], &to = b[(i + 1) % 3];
    const double here = dot(n, from - a[0]), there = dot(n, to - a[0]);
    if ((here < 0) != (there < 0)) in_plane.push_back(from + here / (here - there) * (to - from));
  }
  return in_plane.empty() ? mean(b) : common_place(in_plane, a);
}

}  // namespace tenon
