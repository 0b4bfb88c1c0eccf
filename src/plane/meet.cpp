#include "plane/meet.h"

namespace tenon {

namespace {

Vec2 unit(const Vec2& v) {
  return 1 / length(v) * v;
}

std::optional<Vec2> lines_meet(const Curve& a, const Curve& b) {
  const Vec2 u = a.to - a.from, v = b.to - b.from;
  const double turn = cross(u, v);
  // Two directions whose angle is lost in their rounding have no place of their own to meet in.
  if (std::fabs(turn) <= 0x1p-40 * length(u) * length(v)) return std::nullopt;
  return a.from + cross(b.from - a.from, v) / turn * u;
}

// Of the two points at `offset` either way along `along` from `foot`, the nearer one.
Vec2 nearer(const Vec2& foot, const Vec2& along, double offset, const Vec2& near) {
  return foot + std::copysign(offset, dot(near - foot, along)) * along;
}

std::optional<Vec2> line_meets_circle(const Curve& line, const Circle& circle, const Vec2& near, double same_place) {
  const Vec2 u = unit(line.to - line.from);
  const Vec2 foot = line.from + dot(circle.center - line.from, u) * u;
  const double distance = length(foot - circle.center),
               square = (circle.radius - distance) * (circle.radius + distance);
  if (std::fabs(circle.radius - distance) <= same_place) return foot;
  if (square < 0) return std::nullopt;
  return nearer(foot, u, std::sqrt(square), near);
}

std::optional<Vec2> circles_meet(const Circle& a, const Circle& b, const Vec2& near, double same_place) {
  const Vec2 w = b.center - a.center;
  const double d = length(w);
  if (!(d > same_place)) return std::nullopt;
  const Vec2 u = 1 / d * w;
  // From the centre of a to the line through the points where they meet.
  const double to_line = 0.5 * (d + (a.radius - b.radius) * (a.radius + b.radius) / d);
  const Vec2 foot = a.center + to_line * u;
  const double touch = std::min(std::fabs(a.radius + b.radius - d), std::fabs(std::fabs(a.radius - b.radius) - d));
  if (touch <= same_place) return a.center + std::copysign(a.radius, to_line) * u;
  const double square = (a.radius - to_line) * (a.radius + to_line);
  if (square < 0) return std::nullopt;
  return nearer(foot, {-u.y, u.x}, std::sqrt(square), near);
}

}  // namespace

std::optional<Vec2> meet(const Curve& a, const Curve& b, const Vec2& near, double same_place) {
  if (!a.is_arc() && !b.is_arc()) return lines_meet(a, b);
  if (!a.is_arc()) return line_meets_circle(a, b.circle, near, same_place);
  if (!b.is_arc()) return line_meets_circle(b, a.circle, near, same_place);
  return circles_meet(a.circle, b.circle, near, same_place);
}

bool are_same_curve(const Curve& a, const Curve& b, double same_place) {
  if (a.is_arc() != b.is_arc()) return false;
  if (a.is_arc()) {
    return length(a.circle.center - b.circle.center) <= same_place &&
           std::fabs(a.circle.radius - b.circle.radius) <= same_place;
  }
  const Vec2 w = a.to - a.from;
  const double near = same_place * length(w);
  return std::fabs(cross(w, b.from - a.from)) <= near && std::fabs(cross(w, b.to - a.from)) <= near;
}

}  // namespace tenon
