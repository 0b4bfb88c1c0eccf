#include "lang/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "lang/primitive_arguments.h"
#include "mesh/build_mesh.h"
#include "primitive/convex_polyhedron.h"

namespace tenon::lang {

namespace {

using Face = std::vector<std::size_t>;
using EdgeFaces = std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>>;

EdgeFaces edges_of(const std::vector<Face>& faces) {
  EdgeFaces edges;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t i = 0; i < faces[f].size(); ++i) {
      const std::size_t a = faces[f][i], b = faces[f][(i + 1) % faces[f].size()];
      if (a != b) edges[std::minmax(a, b)].push_back(f);
    }
  }
  return edges;
}

/// Gathers the planes of faces; what several of them share is named once.
class PlaneFinder {
 public:
  PlaneFinder(const std::vector<Vec3>& points, const std::vector<Face>& faces) : points_(points), faces_(faces) {
    std::vector<Vec3> used;
    for (const Face& face : faces) {
      for (std::size_t i : face) used.push_back(points[i]);
    }
    Vec3 lower = used.front(), upper = used.front();
    for (const Vec3& p : used) lower = min(lower, p), upper = max(upper, p);
    // Any point inside a convex shape tells which way its planes face. The centroid of the corners is one.
    for (const Vec3& p : used) inside_ += p / static_cast<double>(used.size());
    // Features below 2^-40 of the largest coordinate are promised nowhere; what is less flat than that is bent.
    tolerance_ = 0x1p-40 * max_component(max(abs(lower), abs(upper)));
  }

  std::optional<BadPolyhedron> find(const EdgeFaces& edges) {
    std::vector<std::optional<std::size_t>> plane_of(faces_.size());
    std::vector<std::vector<std::size_t>> neighbours(faces_.size());
    for (const auto& [edge, beside] : edges) {
      for (std::size_t f : beside) {
        for (std::size_t g : beside) {
          if (g != f) neighbours[f].push_back(g);
        }
      }
    }
    // The largest first: what is next to nothing wide has a plane of few true digits, and lies in that of another.
    for (const std::size_t f : by_size()) {
      for (std::size_t g : neighbours[f]) {
        if (plane_of[g] && lies_in(f, planes_[*plane_of[g]])) plane_of[f] = plane_of[g];
      }
      // Of many planes it is a mesh, and they are not asked for.
      for (std::size_t i = 0; i < planes_.size() && planes_.size() <= most_planes && !plane_of[f]; ++i) {
        if (lies_in(f, planes_[i])) plane_of[f] = i;
      }
      if (plane_of[f]) continue;
      const std::optional<Plane> plane = plane_of_face(f);
      if (!plane) continue;  // without area, and so without a side of its own
      if (!lies_in(f, *plane)) {
        return BadPolyhedron{"face " + std::to_string(f) + " of the polyhedron is not flat", false, true};
      }
      plane_of[f] = planes_.size();
      planes_.push_back(*plane);
    }
    put_in_order(plane_of);
    return std::nullopt;
  }

  // A point outside of a plane, with that plane's normal turned away from the inside.
  bool all_points_are_within() const {
    for (const Plane& plane : planes_) {
      for (const Face& face : faces_) {
        for (std::size_t i : face) {
          if (dot(plane.normal, points_[i]) - plane.d > tolerance_) return false;
        }
      }
    }
    return true;
  }

  bool is_flat() const {
    return planes_.empty() || std::any_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
             return std::all_of(faces_.begin(), faces_.end(), [&](const Face& face) {
               return std::all_of(face.begin(), face.end(), [&](std::size_t i) {
                 return std::fabs(dot(plane.normal, points_[i]) - plane.d) <= tolerance_;
               });
             });
           });
  }

  const std::vector<Plane>& planes() const { return planes_; }

 private:
  bool lies_in(std::size_t f, const Plane& plane) const {
    return std::all_of(faces_[f].begin(), faces_[f].end(),
                       [&](std::size_t i) { return std::fabs(dot(plane.normal, points_[i]) - plane.d) <= tolerance_; });
  }

  // Planes are numbered as the first of their faces are.
  void put_in_order(const std::vector<std::optional<std::size_t>>& plane_of) {
    std::vector<Plane> ordered;
    std::vector<bool> is_taken(planes_.size());
    for (const auto& plane : plane_of) {
      if (plane && !is_taken[*plane]) ordered.push_back(planes_[*plane]);
      if (plane) is_taken[*plane] = true;
    }
    planes_ = std::move(ordered);
  }

  // Newell's: as long as twice the area.
  Vec3 normal_of(std::size_t f) const {
    const Face& face = faces_[f];
    const Vec3 origin = points_[face.front()];
    Vec3 normal;
    for (std::size_t i = 0; i < face.size(); ++i) {
      normal += cross(points_[face[i]] - origin, points_[face[(i + 1) % face.size()]] - origin);
    }
    return normal;
  }

  std::vector<std::size_t> by_size() const {
    std::vector<std::pair<double, std::size_t>> sizes;
    for (std::size_t f = 0; f < faces_.size(); ++f) sizes.emplace_back(-length(normal_of(f)), f);
    std::sort(sizes.begin(), sizes.end());
    std::vector<std::size_t> faces;
    for (const auto& [size, f] : sizes) faces.push_back(f);
    return faces;
  }

  // Newell's normal, and the outermost corner's distance; null for a face without area.
  std::optional<Plane> plane_of_face(std::size_t f) const {
    const Face& face = faces_[f];
    const Vec3 origin = points_[face.front()];
    Vec3 normal = normal_of(f);
    double longest = 0;
    for (const std::size_t i : face) longest = std::max(longest, length(points_[i] - origin));
    if (!(length(normal) > tolerance_ * longest)) return std::nullopt;
    normal = normalize(normal);
    if (dot(normal, inside_ - origin) > 0) normal = -normal;
    double d = dot(normal, origin);
    for (std::size_t i : face) d = std::max(d, dot(normal, points_[i]));
    return Plane{normal, d};
  }

  const std::vector<Vec3>& points_;
  const std::vector<Face>& faces_;
  Vec3 inside_;
  double tolerance_ = 0;
  std::vector<Plane> planes_;
};

Solid mesh_solid(ModuleEvaluator& evaluator, const std::vector<Vec3>& points, const std::vector<Face>& faces,
                 Place at) {
  PolygonSoup soup;
  soup.points = points;
  for (const Face& face : faces) soup.add_face(std::vector<std::uint32_t>(face.begin(), face.end()));
  Result<BuiltMesh> built = build_mesh(soup, "the polyhedron", false);
  if (!built) fail(at, built.error().message);
  for (const std::string& note : built->notes) evaluator.environment().warn(at, note);
  return add_primitive(evaluator, at, "mesh", {std::make_shared<const TriangleMesh>(std::move(built->mesh)), false});
}

// Whether planes enclose what they are of: those of faces next to nothing wide, or next to parallel, may meet
// elsewhere.
bool reach_as_far(const std::vector<Plane>& planes, const std::vector<Vec3>& points, const std::vector<Face>& faces) {
  ConvexPolyhedron polyhedron;
  polyhedron.planes = planes;
  polyhedron.prepare();
  if (!polyhedron.check().empty()) return false;
  Vec3 lower = points[faces.front().front()], upper = lower;
  for (const Face& face : faces) {
    for (const std::size_t i : face) lower = min(lower, points[i]), upper = max(upper, points[i]);
  }
  // Bounds of vertices are generous; what is off by more than this would show.
  const double most = 0x1p-30 * max_component(max(abs(lower), abs(upper)));
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return std::all_of(std::begin(axes), std::end(axes), [&](const Vec3& n) {
    return std::fabs(polyhedron.support(n) - dot(n, upper)) <= most &&
           std::fabs(polyhedron.support(-n) + dot(n, lower)) <= most;
  });
}

}  // namespace

std::variant<std::vector<Plane>, BadPolyhedron> planes_of(const std::vector<Vec3>& points,
                                                          const std::vector<Face>& faces) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (faces[f].size() < 3) {
      return BadPolyhedron{"face " + std::to_string(f) + " of the polyhedron has fewer than three points"};
    }
    for (std::size_t i : faces[f]) {
      if (i >= points.size()) {
        return BadPolyhedron{"face " + std::to_string(f) + " of the polyhedron names point " + std::to_string(i) +
                             ", but there are only " + std::to_string(points.size()) + " points, counted from 0"};
      }
    }
  }
  if (faces.empty()) return BadPolyhedron{"the polyhedron has no faces; it makes no solid", true};
  const EdgeFaces edges = edges_of(faces);
  PlaneFinder finder(points, faces);
  if (auto bad = finder.find(edges)) return *bad;
  if (finder.is_flat()) return BadPolyhedron{"the polyhedron has no volume; it makes no solid", true};
  for (const auto& [edge, beside] : edges) {
    if (beside.size() == 2) continue;
    // Where solids touch, along an edge, more faces meet.
    if (beside.size() % 2 == 0) return BadPolyhedron{"the polyhedron is not convex", false, true};
    return BadPolyhedron{"the polyhedron is not closed: the edge from point " + std::to_string(edge.first) +
                         " to point " + std::to_string(edge.second) + " borders " + std::to_string(beside.size()) +
                         (beside.size() == 1 ? " face" : " faces") + ", not two"};
  }
  // Of so many planes it is a mesh, convex or not, and the question would take time with the square of their number.
  if (finder.planes().size() > most_planes || !finder.all_points_are_within()) {
    return BadPolyhedron{"the polyhedron is not convex", false, true};
  }
  return finder.planes();
}

Solid polyhedron_solid(ModuleEvaluator& evaluator, const std::vector<Vec3>& points, const std::vector<Face>& faces,
                       Place at) {
  auto result = planes_of(points, faces);
  const auto* bad = std::get_if<BadPolyhedron>(&result);
  if (!bad && reach_as_far(std::get<0>(result), points, faces)) {
    return add_primitive(evaluator, at, "convex_polyhedron", {std::get<0>(std::move(result))});
  }
  if (!bad || bad->is_general) return mesh_solid(evaluator, points, faces, at);
  if (!bad->empty) fail(at, bad->message);
  evaluator.environment().warn(at, bad->message);
  return Solid::nothing();
}

}  // namespace tenon::lang
