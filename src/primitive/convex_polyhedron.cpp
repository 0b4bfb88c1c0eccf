#include "primitive/convex_polyhedron.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "primitive/check.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// The planes with normals of length 1.
std::vector<Plane> normalized(const std::vector<Plane>& planes) {
  std::vector<Plane> result;
  for (const Plane& plane : planes) {
    const double scale = max_component(abs(plane.normal));
    const Vec3 n = plane.normal / scale;
    const double l = length(n);
    result.push_back({n / l, plane.d / scale / l});
  }
  return result;
}

std::string check_planes(const std::vector<Plane>& planes) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const std::string plane = "plane " + std::to_string(i + 1) + " of convex_polyhedron ";
    const double largest = max_component(abs(planes[i].normal));
    if (!std::isfinite(largest + std::fabs(planes[i].d))) return plane + "is not finite";
    if (!(largest > 0)) return plane + "has a normal of length 0";
    if (largest < smallest_size || largest > largest_size || std::fabs(planes[i].d) > largest_size) {
      return plane + "is too small or too large to compute with";
    }
  }
  return {};
}

// Planes that come from corners are known to what those round by, over the size of the faces: what meets at a smaller
// angle counts as parallel. A place is then off by this much of the distance (features below 2^-40 are promised
// nowhere), which its slack says.
constexpr double least_angle = 0x1p-38;

// The part of the line of two planes that lies behind all the others.
struct Edge {
  Vec3 point, direction;
  double point_error = 0, direction_error = 0;
  double parallel_error = 0;  // by what planes that count as parallel may be off
  double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();
  double begin_error = 0, end_error = 0;

  bool clip(const Plane& plane) {
    const double value = dot(plane.normal, point) - plane.d, slope = dot(plane.normal, direction);
    const double size = max_component(abs(point)) + std::fabs(plane.d);
    const double value_error = 3 * point_error + gamma(8) * size, slope_error = 3 * direction_error + gamma(8);
    if (std::fabs(slope) <= slope_error) return value <= value_error;
    if (std::fabs(slope) <= least_angle) {
      parallel_error = std::max(parallel_error, least_angle * size);
      return value <= value_error + least_angle * size;
    }
    const double t = -value / slope;
    const double error = (value_error + std::fabs(t) * slope_error) / (std::fabs(slope) - slope_error);
    if (slope > 0 && t < end) {
      end = t;
      end_error = error;
    } else if (slope < 0 && t > begin) {
      begin = t;
      begin_error = error;
    }
    return begin - begin_error <= end + end_error;
  }
};

}  // namespace

// A vertex is an end of an edge, and an edge is what the other planes leave of the line that two of them share. An
// unbounded polyhedron with vertices has an unbounded edge; one without vertices has no edges that end.
void ConvexPolyhedron::prepare() {
  vertices_.clear();
  slack_ = 0;
  problem_ = check_planes(planes);
  if (!problem_.empty()) return;
  const std::vector<Plane> p = normalized(planes);

  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      const Vec3 along = cross(p[i].normal, p[j].normal);
      const double sine = length(along);
      if (sine <= least_angle) continue;
      Edge edge;
      edge.direction = along / sine;
      edge.point = (p[i].d * cross(p[j].normal, edge.direction) + p[j].d * cross(edge.direction, p[i].normal)) / sine;
      edge.direction_error = gamma(16) / sine;
      edge.point_error = gamma(16) * (std::fabs(p[i].d) + std::fabs(p[j].d)) / (sine * sine);
      bool exists = true;
      for (std::size_t k = 0; exists && k < p.size(); ++k) {
        if (k != i && k != j) exists = edge.clip(p[k]);
      }
      if (!exists) continue;
      if (!std::isfinite(edge.begin) || !std::isfinite(edge.end)) {
        problem_ = "convex_polyhedron is unbounded; add the planes that close it";
        return;
      }
      for (const double t : {edge.begin, edge.end}) {
        vertices_.push_back(edge.point + t * edge.direction);
        slack_ = std::max(slack_, edge.parallel_error + edge.point_error + std::max(edge.begin_error, edge.end_error) +
                                      std::fabs(t) * (edge.direction_error + gamma(4)));
      }
    }
  }
  problem_ = check_volume(p);
}

std::string ConvexPolyhedron::check_volume(const std::vector<Plane>& unit_planes) const {
  if (vertices_.empty()) return "convex_polyhedron is empty or unbounded; its planes must enclose a volume";
  Vec3 center;
  for (const Vec3& v : vertices_) center += v / static_cast<double>(vertices_.size());
  for (const Plane& plane : unit_planes) {
    // A middle no deeper behind a face than the vertices are known has no volume around it.
    if (!(plane.d - dot(plane.normal, center) > 4 * slack_)) return "convex_polyhedron has no volume";
  }
  return {};
}

}  // namespace tenon
