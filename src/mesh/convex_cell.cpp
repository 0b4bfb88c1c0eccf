#include "mesh/convex_cell.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "mesh/convex_hull.h"

namespace tenon {

namespace {

auto key(const Vec3& p) {
  return std::tuple{p.x, p.y, p.z};
}

Vec3 mean(std::span<const Vec3> points) {
  Vec3 sum;
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

// The corners of a convex polygon in a plane, in order.
std::vector<Vec3> sorted_around(std::vector<Vec3> points, const Vec3& normal) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return key(a) < key(b); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  const Vec3 middle = mean(points);
  const Vec3 size = abs(normal);
  const Vec3 axis = size.x <= size.y && size.x <= size.z ? Vec3{1, 0, 0}
                    : size.y <= size.z                   ? Vec3{0, 1, 0}
                                                         : Vec3{0, 0, 1};
  const Vec3 u = cross(axis, normal), v = cross(normal, u);
  const auto angle = [&](const Vec3& p) { return std::atan2(dot(v, p - middle), dot(u, p - middle)); };
  std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
  return points;
}

}  // namespace

std::optional<FlatPolygon> FlatPolygon::of(std::vector<Vec3> corners) {
  if (corners.size() < 3) return std::nullopt;
  Vec3 normal;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    normal += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  }
  const double size = length(normal);
  if (!(size > 0)) return std::nullopt;
  normal = normal / size;
  const double d = dot(normal, mean(corners));
  return FlatPolygon{{normal, d}, std::move(corners)};
}

double PlaneSide::of(const Vec3& p) const {
  const double distance = dot(plane.normal, p) - plane.d;
  return std::fabs(distance) <= same_place ? 0 : distance;
}

std::vector<Vec3> PlaneSide::behind(std::span<const Vec3> corners) const {
  std::vector<Vec3> result;
  bool has_area = false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    const double at_a = of(a), at_b = of(b);
    has_area |= at_a < 0;
    if (at_a <= 0) result.push_back(a);
    if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) {
      const bool from_a = key(a) < key(b);
      const Vec3 &p = from_a ? a : b, &q = from_a ? b : a;
      const double at_p = from_a ? at_a : at_b, at_q = from_a ? at_b : at_a;
      result.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
  }
  if (!has_area) result.clear();
  return result;
}

std::optional<ConvexCell> ConvexCell::around(std::span<const Vec3> points) {
  const ConvexHull hull = convex_hull(points);
  if (hull.faces.empty()) return std::nullopt;
  const Vec3 middle = mean(hull.points);
  std::vector<FlatPolygon> faces;
  for (const auto& face : hull.faces) {
    std::vector<Vec3> corners;
    for (const std::size_t i : face) corners.push_back(hull.points[i]);
    auto polygon = FlatPolygon::of(corners);
    if (polygon && dot(polygon->plane.normal, middle) > polygon->plane.d) {
      std::reverse(corners.begin(), corners.end());
      polygon = FlatPolygon::of(std::move(corners));
    }
    if (polygon) faces.push_back(std::move(*polygon));
  }
  return ConvexCell(std::move(faces));
}

Vec3 ConvexCell::middle() const {
  std::vector<Vec3> middles;
  for (const FlatPolygon& face : faces_) middles.push_back(mean(face.corners));
  return mean(middles);
}

double ConvexCell::largest_coordinate() const {
  double largest = 0;
  for (const FlatPolygon& face : faces_) {
    for (const Vec3& p : face.corners) largest = std::max(largest, max_component(abs(p)));
  }
  return largest;
}

std::optional<ConvexCell> ConvexCell::behind(const PlaneSide& side) const {
  std::vector<FlatPolygon> faces;
  std::vector<Vec3> rim;
  double most_before = 0, most_behind = 0;
  for (const FlatPolygon& face : faces_) {
    for (const Vec3& p : face.corners) {
      most_before = std::max(most_before, side.of(p));
      most_behind = std::max(most_behind, -side.of(p));
    }
    std::vector<Vec3> rest = side.behind(face.corners);
    if (rest.size() < 3) continue;
    // Corners of the old face that lie in the plane, and new ones, which are but for rounding.
    for (const Vec3& p : rest) {
      const bool is_old = std::find(face.corners.begin(), face.corners.end(), p) != face.corners.end();
      if (!is_old || side.of(p) == 0) rim.push_back(p);
    }
    faces.push_back({face.plane, std::move(rest)});
  }
  if (faces.empty()) return std::nullopt;
  if (most_before == 0) return *this;
  rim = sorted_around(std::move(rim), side.plane.normal);
  // So little lies on one side that rounding makes it an edge.
  if (rim.size() < 3) return most_before > most_behind ? std::nullopt : std::optional(*this);
  faces.push_back({side.plane, std::move(rim)});
  return ConvexCell(std::move(faces));
}

std::vector<ConvexCell> difference(const ConvexCell& a, const ConvexCell& b, double same_place) {
  if (!intersection(a, b, same_place)) return {a};
  std::vector<ConvexCell> parts;
  std::optional<ConvexCell> rest = a;
  for (const FlatPolygon& face : b.faces()) {
    const PlaneSide side{face.plane, same_place};
    if (auto part = rest->behind(side.reversed())) parts.push_back(std::move(*part));
    rest = rest->behind(side);
    if (!rest) break;
  }
  return parts;
}

std::optional<ConvexCell> intersection(const ConvexCell& a, const ConvexCell& b, double same_place) {
  std::optional<ConvexCell> rest = a;
  for (const FlatPolygon& face : b.faces()) {
    rest = rest->behind({face.plane, same_place});
    if (!rest) break;
  }
  return rest;
}

}  // namespace tenon
