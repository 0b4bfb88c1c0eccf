#include "lang/polyhedron_facets.h"

#include "mesh/convex_hull.h"

namespace tenon::lang {

std::optional<PolyhedronFacets> polyhedron_facets(const UnionLeaf& leaf) {
  PolyhedronFacets facets;
  if (leaf.kind == "mesh") {
    const TriangleMesh& mesh = *std::get<SharedMesh>(leaf.values[0]);
    if (std::get<bool>(leaf.values[1])) return std::nullopt;
    facets.points = mesh.vertices;
    facets.triangles = mesh.triangles;
  } else if (leaf.kind == "cube" || leaf.kind == "convex_polyhedron") {
    const auto balls = spanning_balls({leaf.kind, leaf.values, {}});
    std::vector<Vec3> points;
    for (const Ball& ball : balls->balls) points.push_back(ball.center);
    const ConvexHull hull = convex_hull(points);
    Vec3 middle;
    for (const Vec3& p : hull.points) middle += p / static_cast<double>(hull.points.size());
    facets.points = hull.points;
    for (const auto& face : hull.faces) {
      for (std::size_t i = 2; i < face.size(); ++i) {
        TriangleMesh::Corners c{static_cast<std::uint32_t>(face[0]), static_cast<std::uint32_t>(face[i - 1]),
                                static_cast<std::uint32_t>(face[i])};
        const Vec3 &p = hull.points[c[0]], &q = hull.points[c[1]], &r = hull.points[c[2]];
        if (dot(cross(q - p, r - p), p - middle) < 0) std::swap(c[1], c[2]);
        facets.triangles.push_back(c);
      }
    }
  } else {
    return std::nullopt;
  }
  for (Vec3& p : facets.points) p = leaf.map.point(p);
  if (leaf.map.determinant() < 0) {
    for (auto& corners : facets.triangles) std::swap(corners[1], corners[2]);
  }
  return facets;
}

}  // namespace tenon::lang
