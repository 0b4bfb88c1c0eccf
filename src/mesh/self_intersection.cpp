#include "mesh/self_intersection.h"

#include <cmath>

#include "primitive/mesh_bvh.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

using Triangle = std::array<Vec3, 3>;

// The sign of the volume of a tetrahedron; 0 where rounding leaves it open.
int certain_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 u = a - p, v = b - p, w = c - p;
  const double value = dot(u, cross(v, w));
  const Vec3 mu = abs(u), mv = abs(v), mw = abs(w);
  const double terms = dot(mu, Vec3{mv.y * mw.z + mv.z * mw.y, mv.z * mw.x + mv.x * mw.z, mv.x * mw.y + mv.y * mw.x});
  // Three differences round, a product of two, their difference, a product of three and two sums: seven in all, and as
  // many for the terms themselves.
  if (std::fabs(value) <= gamma(14) * terms) return 0;
  return value > 0 ? 1 : -1;
}

// Where the segment p→q certainly passes through the inside of a triangle.
std::optional<Vec3> pierces(const Vec3& p, const Vec3& q, const Triangle& t) {
  const int side = certain_side(t[0], t[1], t[2], p);
  if (side == 0 || certain_side(t[0], t[1], t[2], q) != -side) return std::nullopt;
  const int turn = certain_side(p, q, t[0], t[1]);
  if (turn == 0 || certain_side(p, q, t[1], t[2]) != turn || certain_side(p, q, t[2], t[0]) != turn) {
    return std::nullopt;
  }
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double before = dot(n, p - t[0]), behind = dot(n, q - t[0]);
  return p + before / (before - behind) * (q - p);
}

std::optional<Vec3> cross_each_other(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (const auto place = pierces(a[i], a[(i + 1) % 3], b)) return place;
    if (const auto place = pierces(b[i], b[(i + 1) % 3], a)) return place;
  }
  return std::nullopt;
}

}  // namespace

std::optional<SelfIntersection> find_self_intersection(const TriangleMesh& mesh) {
  const MeshBvh bvh(mesh);
  SelfIntersection found;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle triangle = mesh.corners(t);
    const Box3 box{min(triangle[0], min(triangle[1], triangle[2])), max(triangle[0], max(triangle[1], triangle[2]))};
    bvh.walk(box, [&](std::uint32_t other) {
      if (other <= t) return true;
      const auto place = cross_each_other(triangle, mesh.corners(other));
      if (!place) return true;
      if (found.count == 0 || (t == found.first && other < found.second)) {
        found.first = t;
        found.second = other;
        found.place = *place;
      }
      return ++found.count < SelfIntersection::most_counted;
    });
    if (found.count >= SelfIntersection::most_counted) break;
  }
  if (found.count == 0) return std::nullopt;
  return found;
}

}  // namespace tenon
