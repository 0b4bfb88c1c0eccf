#include "primitive/polygon3d.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/flatness.h"
#include "primitive/half_space.h"
#include "tenon/math/rounding.h"

namespace tenon {

void Polygon3d::prepare() {
  if (!check().empty()) return;
  plane_ = plane_of_loops(points);
  const Vec3 n = abs(plane_.normal);
  axis_ = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
  edges_.clear();
  begin_of_.assign(1, 0);
  for (std::size_t l = 0; l < points.size(); ++l) {
    const std::vector<Vec3>& loop = points[l];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t next = (i + 1) % loop.size();
      const auto normal_at = [&](std::size_t k) { return normals.empty() ? plane_.normal : normalize(normals[l][k]); };
      edges_.push_back({loop[i], loop[next], normal_at(i), normal_at(next)});
      deviation_ = std::max(deviation_, std::fabs(dot(plane_.normal, loop[i]) - plane_.d));
    }
    begin_of_.push_back(edges_.size());
  }
}

std::string Polygon3d::check() const {
  double largest = 0;
  if (points.empty()) return "polygon3d without corners shows nothing";
  for (const std::vector<Vec3>& loop : points) {
    if (loop.size() < 3) return "a loop of polygon3d has fewer than three corners";
    for (const Vec3& p : loop) {
      if (!std::isfinite(p.x + p.y + p.z)) return "a corner of polygon3d is not finite";
      largest = std::max(largest, max_component(abs(p)));
    }
  }
  if (std::string problem = check_lengths(name, {{"the largest coordinate", largest}}); !problem.empty())
    return problem;
  if (plane_of_loops(points).normal == Vec3{}) return "polygon3d has no area";
  if (const auto deviation = find_deviation(points)) {
    return "polygon3d is not planar: its corners deviate from a plane by " + shortest(*deviation);
  }
  if (normals.empty()) return {};
  bool fits = normals.size() == points.size();
  for (std::size_t l = 0; fits && l < points.size(); ++l) fits = normals[l].size() == points[l].size();
  if (!fits) return "polygon3d needs as many normals as corners, or none";
  for (const std::vector<Vec3>& loop : normals) {
    for (const Vec3& n : loop) {
      const double size = length(n);
      if (!(size > smallest_size && size < largest_size)) return "a normal of polygon3d has no direction";
    }
  }
  return {};
}

double Polygon3d::support(const Vec3& n) const {
  double greatest = -std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges_) greatest = std::max(greatest, dot(n, edge.from));
  return greatest;
}

void Polygon3d::spans(const LocalRay& ray, Spans& out) const {
  BoundedLine f = plane_along(ray, plane_.normal, plane_.d);
  // The corners are off the plane that was computed for them, the plane's distance by its rounding.
  f.value_error += deviation_ + gamma(4) * std::fabs(plane_.d);
  // A surface that is seen edge on shows nothing.
  if (!(std::fabs(f.slope) > f.slope_error)) return;
  const End at = plane_end(f, 0, ray.on_face == 0);
  const double bound = at.given ? 0 : std::max({at.hi - at.t, at.t - at.lo, 0.0}) * (1 + gamma(4));
  const Vec3 p = ray.origin + at.t * ray.direction;
  const Vec3 slip = ray.origin_error + std::fabs(at.t) * ray.direction_error +
                    gamma(2) * (abs(ray.origin) + std::fabs(at.t) * abs(ray.direction));
  if (!std::isfinite(at.t) || !std::isfinite(bound)) return;
  double distance = 0, along = 0;
  nearest_edge(p, distance, along);
  const bool may_touch = at.given || distance <= length(slip) + bound * length(ray.direction);
  if (may_touch || find(p).inside) out.push_back({at.t, bound, 0, false, true});
}

Region Polygon3d::classify(const LocalBox& box) const {
  const Extent extent = extent_along(box, plane_.normal);
  if (std::fabs(extent.center - plane_.d) > extent.radius + deviation_ + gamma(4) * std::fabs(plane_.d)) {
    return Region::outside;
  }
  return is_separated_by_box_faces(box, *this) ? Region::outside : Region::straddles;
}

Vec3 Polygon3d::normal(const Vec3& point, std::uint32_t) const {
  if (normals.empty()) return plane_.normal;
  const Found found = find(point);
  if (found.inside && dot(found.normal, found.normal) > 0) return found.normal;
  // On the edge, or next to it.
  double distance = 0, along = 0;
  const Edge& edge = nearest_edge(point, distance, along);
  const Vec3 n = (1 - along) * edge.from_normal + along * edge.to_normal;
  return n == Vec3{} ? plane_.normal : n;
}

const Polygon3d::Edge& Polygon3d::nearest_edge(const Vec3& point, double& distance, double& along) const {
  const Edge* nearest = nullptr;
  distance = std::numeric_limits<double>::infinity();
  for (const Edge& edge : edges_) {
    const Vec3 w = edge.to - edge.from, p = point - edge.from;
    const double square = dot(w, w);
    const double at = square > 0 ? std::clamp(dot(p, w) / square, 0.0, 1.0) : 0;
    const double away = length(p - at * w);
    if (nearest != nullptr && !(away < distance)) continue;
    nearest = &edge;
    distance = away;
    along = at;
  }
  return *nearest;
}

Polygon3d::Found Polygon3d::find(const Vec3& point) const {
  return method.index == 0 ? find_by_snyder(point) : find_by_marchal(point);
}

// Each loop as the triangles of a fan around its first corner. Triangles that turn the other way take back what the
// others have covered too much, of the area and, weighed by their barycentric coordinates, of the normals.
Polygon3d::Found Polygon3d::find_by_snyder(const Vec3& point) const {
  Found found;
  for (std::size_t l = 0; l + 1 < begin_of_.size(); ++l) {
    const Edge& first = edges_[begin_of_[l]];
    const Vec3 apex = first.from - point;
    // Of the triangle apex, p, q: twice the areas opposite to its corners, by the one way of computing each.
    double from_side = area(apex, first.to - point);
    for (std::size_t e = begin_of_[l] + 1; e + 1 < begin_of_[l + 1]; ++e) {
      const Edge& edge = edges_[e];
      const Vec3 p = edge.from - point, q = edge.to - point;
      const double opposite = area(p, q), to_side = area(apex, q);
      const bool left = from_side >= 0;
      if (left == (opposite >= 0) && left != (to_side >= 0)) {
        found.inside = !found.inside;
        const double whole = opposite - to_side + from_side;
        const Vec3 sum = opposite * first.from_normal - to_side * edge.from_normal + from_side * edge.to_normal;
        if (whole != 0) found.normal += (left ? 1 : -1) * (sum / whole);
      }
      from_side = to_side;
    }
  }
  // Loops that run clockwise as seen along the normal's largest component have come out negative.
  if (plane_.normal[axis_] < 0) found.normal = -found.normal;
  return found;
}

// Along the line from the first corner through the point: inside when an odd number of edges lies beyond it. The
// normals are interpolated along the two edges on either side of the point, and between those.
Polygon3d::Found Polygon3d::find_by_marchal(const Vec3& point) const {
  Found found;
  const Vec3 origin = edges_.front().from, v_axis = point - origin;
  const auto flat_dot = [this](const Vec3& a, const Vec3& b) { return dot(a, b) - a[axis_] * b[axis_]; };
  const double here = flat_dot(v_axis, v_axis);
  double before = -std::numeric_limits<double>::infinity(), beyond = std::numeric_limits<double>::infinity();
  Vec3 normal_before = edges_.front().from_normal, normal_beyond = normal_before;
  for (const Edge& edge : edges_) {
    const double u1 = area(v_axis, edge.from - origin), u2 = area(v_axis, edge.to - origin);
    if ((u1 >= 0) == (u2 >= 0)) continue;
    const double s = u1 / (u1 - u2);
    const double v = (1 - s) * flat_dot(v_axis, edge.from - origin) + s * flat_dot(v_axis, edge.to - origin);
    const Vec3 normal = (1 - s) * edge.from_normal + s * edge.to_normal;
    if (v > here) {
      found.inside = !found.inside;
      if (v < beyond) {
        beyond = v;
        normal_beyond = normal;
      }
    } else if (v > before) {
      before = v;
      normal_before = normal;
    }
  }
  if (!found.inside) return found;
  before = std::max(before, 0.0);
  const double share = beyond > before ? (here - before) / (beyond - before) : 0;
  found.normal = (1 - share) * normal_before + share * normal_beyond;
  return found;
}

}  // namespace tenon
