#include "primitive/mesh.h"

#include <algorithm>
#include <cmath>

#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/mesh_edges.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// Within these no product of three coordinates, nor the tail of one, leaves the range of double, and boxes fit a float.
constexpr double smallest_mesh = 1e-30, largest_mesh = 1e30;

std::string check_numbers(const TriangleMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double coordinate = max_component(abs(mesh.vertices[i]));
    if (!std::isfinite(dot(mesh.vertices[i], {0, 0, 0}))) return "vertex " + std::to_string(i) + " is not finite";
    largest = std::max(largest, coordinate);
  }
  if (mesh.triangles.empty()) return "it has no triangles";
  if (largest < smallest_mesh) return "it is too small to compute with; coordinates start at 1e-30";
  if (largest > largest_mesh) return "it is too large to compute with; coordinates end at 1e30";
  if (mesh.corner_normals.size() != (mesh.normals.empty() ? 0 : mesh.triangles.size())) {
    return "its normals do not fit its triangles";
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string triangle = "triangle " + std::to_string(t);
      if (mesh.triangles[t][i] >= count) return triangle + " names a vertex that is not there";
      if (!mesh.normals.empty() && mesh.corner_normals[t][i] >= mesh.normals.size()) {
        return triangle + " names a normal that is not there";
      }
    }
  }
  return {};
}

// n·p over three points.
Extent extent_along(const std::array<Vec3, 3>& p, const Vec3& n) {
  const double a = dot(n, p[0]), b = dot(n, p[1]), c = dot(n, p[2]);
  const double least = std::min({a, b, c}), greatest = std::max({a, b, c});
  const Vec3 reach = max(abs(p[0]), max(abs(p[1]), abs(p[2])));
  return {0.5 * least + 0.5 * greatest, 0.5 * (greatest - least) + gamma(6) * dot(abs(n), reach)};
}

bool overlap(const Extent& a, const Extent& b) {
  return a.least() <= b.greatest() && b.least() <= a.greatest();
}

Box3 box_around(const std::array<Vec3, 3>& p) {
  return {min(p[0], min(p[1], p[2])), max(p[0], max(p[1], p[2]))};
}

}  // namespace

SharedMesh Mesh::unit_tetrahedron() {
  static const SharedMesh mesh = [] {
    TriangleMesh tetrahedron;
    tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return std::make_shared<const TriangleMesh>(std::move(tetrahedron));
  }();
  return mesh;
}

void Mesh::prepare() {
  if (!mesh || !check_numbers(*mesh).empty()) return;
  auto index = std::make_shared<Index>();
  if (mesh->local == MeshStructure::kd) {
    index->structure.emplace<MeshKdTree>(*mesh);
  } else {
    index->structure.emplace<MeshBvh>(*mesh);
  }
  for (std::uint32_t t = 0; t < mesh->triangles.size(); ++t) {
    for (const Vec3& corner : mesh->corners(t)) index->bounds = tenon::hull(index->bounds, corner);
    index->facet += 0.5 * length(flat_normal(t)) / static_cast<double>(mesh->triangles.size());
  }
  if (!hull) {
    const auto walk = [&index](const MeshLine& line, FunctionRef<void(std::uint32_t)> visit) {
      index->walk(line, {}, visit);
    };
    index->clear = ClearCells(*mesh, index->bounds, walk);
  }
  index_ = std::move(index);
}

void Mesh::Index::walk(const MeshLine& line, const LineWindow& window, FunctionRef<void(std::uint32_t)> visit) const {
  if (const auto* bvh = std::get_if<MeshBvh>(&structure)) {
    bvh->walk(line, window, visit);
  } else {
    std::get<MeshKdTree>(structure).walk(line, visit);
  }
}

void Mesh::Index::walk_forward(const MeshLine& line, const LineWindow& window,
                               FunctionRef<double(std::uint32_t)> visit) const {
  if (const auto* bvh = std::get_if<MeshBvh>(&structure)) {
    bvh->walk_forward(line, window, visit);
  } else {
    std::get<MeshKdTree>(structure).walk(line, [&](std::uint32_t triangle) { visit(triangle); });
  }
}

std::string Mesh::check() const {
  if (!mesh) return "mesh is missing";
  if (std::string problem = check_numbers(*mesh); !problem.empty()) return "mesh makes no solid: " + problem;
  if (hull) return {};
  if (const auto open = find_open_edges(mesh->triangles)) {
    return "mesh makes no solid: " + std::to_string(open->count) +
           " of its edges are not run along as often in one direction as in the other";
  }
  return {};
}

double Mesh::support(const Vec3& n) const {
  if (const auto* bvh = std::get_if<MeshBvh>(&index_->structure)) return bvh->support(*mesh, n);
  double best = -Box3::inf;
  for (const TriangleMesh::Corners& corners : mesh->triangles) {
    for (const std::uint32_t v : corners) best = std::max(best, dot(n, mesh->vertices[v]));
  }
  return best;
}

Vec3 Mesh::flat_normal(std::uint32_t face) const {
  const auto [a, b, c] = mesh->corners(face);
  const Vec3 n = cross(b - a, c - a);
  return n == Vec3{} ? Vec3{0, 0, 1} : n;
}

Vec3 Mesh::normal(const Vec3& point, std::uint32_t face) const {
  const Vec3 flat = flat_normal(face);
  if (mesh->normals.empty()) return flat;
  const auto [a, b, c] = mesh->corners(face);
  // Barycentric coordinates by areas; of a triangle without any, one corner's normal will do.
  const double area = dot(flat, flat);
  Vec3 weight{dot(flat, cross(b - point, c - point)), dot(flat, cross(c - point, a - point)),
              dot(flat, cross(a - point, b - point))};
  weight = area > 0 ? max(weight / area, Vec3{}) : Vec3{1, 0, 0};
  const TriangleMesh::Corners& n = mesh->corner_normals[face];
  const Vec3 smooth = weight.x * normalize(mesh->normals[n[0]]) + weight.y * normalize(mesh->normals[n[1]]) +
                      weight.z * normalize(mesh->normals[n[2]]);
  return dot(smooth, flat) > 0 ? smooth : flat;
}

// The separating axes of two convex bodies: the faces of each, and the cross products of their edges.
bool Mesh::meets(const FacedBox& faced, std::uint32_t triangle) const {
  const LocalBox& box = faced.box;
  const std::array<Vec3, 3> p = mesh->corners(triangle);
  if (!box_around(p).overlaps(box.bounds)) return false;
  // To say so of a corner that lies beside the box by a rounding is never wrong (Region::straddles).
  if (std::any_of(p.begin(), p.end(), [&](const Vec3& corner) { return faced.contains(corner); })) return true;
  const auto separates = [&](const Vec3& n) { return !overlap(extent_along(box, n), extent_along(p, n)); };
  const std::array<Vec3, 3> edges{p[1] - p[0], p[2] - p[1], p[0] - p[2]};
  if (separates(cross(edges[0], edges[1]))) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (separates(faced.normals[i])) return false;
    for (const Vec3& edge : edges) {
      if (separates(cross(box.half_edges[i], edge))) return false;
    }
  }
  return true;
}

Region Mesh::classify(const LocalBox& box) const {
  if (!index_->bounds.overlaps(box.bounds)) return Region::outside;
  const FacedBox faced(box);
  const auto is_clear = [&](const auto& structure) {
    return structure.walk(box.bounds, [&](std::uint32_t t) { return !meets(faced, t); });
  };
  if (!std::visit(is_clear, index_->structure)) return Region::straddles;
  if (hull) return Region::outside;
  // No face comes near the box, so its middle tells.
  const std::optional<bool> is_inside = contains_middle(box);
  if (!is_inside) return Region::straddles;
  return *is_inside ? Region::inside : Region::outside;
}

// By a line through it, of which nothing near it may be in doubt.
std::optional<bool> Mesh::contains_middle(const LocalBox& box) const {
  if (const auto winding = index_->clear.winding_at(box.center)) return *winding > 0;
  Spans crossings;
  for (int axis = 0; axis < 3; ++axis) {
    LocalRay ray;
    ray.origin = box.center;
    ray.direction[axis] = 1;
    crossings.clear();
    spans_within(ray, {0, 0}, crossings);
    bool inside = false, certain = true;
    for (const Crossing& c : crossings) {
      inside ^= c.t <= 0;
      certain = certain && std::fabs(c.t) > c.bound;
    }
    if (certain) return inside;
  }
  return std::nullopt;
}

}  // namespace tenon
