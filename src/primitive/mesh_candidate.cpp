#include <algorithm>
#include <cmath>

#include "primitive/edge_sign.h"
#include "primitive/mesh_candidate-inl.h"
#include "primitive/mesh_crossings.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {

bool find_candidate(const MeshLine& line, const TriangleMesh& mesh, std::uint32_t triangle, MeshCandidate& out) {
  const std::array<Vec3, 3> p = mesh.corners(triangle);
  const HWY_NAMESPACE::SeenTriangle<double> seen = HWY_NAMESPACE::SeeTriangle(line, p);
  if (seen.is_missed) return false;
  // What is in doubt must not depend on how generous the boxes are that the triangle was found in.
  if (!seen.is_certain && !MeshSlabs(line).meets({min(p[0], min(p[1], p[2])), max(p[0], max(p[1], p[2]))}))
    return false;

  out.triangle = triangle;
  const int facing = line.direction[line.along] > 0 ? 1 : -1;
  out.is_certain = seen.is_certain;
  const auto& [u, v, w] = seen.areas;
  const auto is_doubtful = [](const HWY_NAMESPACE::EdgeArea<double>& area) {
    return !area.is_positive() && !area.is_negative();
  };
  out.is_doubtful = {is_doubtful(u), is_doubtful(v), is_doubtful(w)};
  if (out.is_certain) {
    out.is_hit = true;
    out.sense = seen.positive ? facing : -facing;
  } else {
    const int bc = edge_sign(line.origin, line.direction, p[1], p[2]);
    const int ca = edge_sign(line.origin, line.direction, p[2], p[0]);
    const int ab = edge_sign(line.origin, line.direction, p[0], p[1]);
    out.is_hit = bc != 0 && bc == ca && bc == ab;
    const double sum = u.value + v.value + w.value, error = u.error + v.error + w.error;
    out.sense = out.is_hit ? bc : sum > error ? facing : sum < -error ? -facing : 0;
  }
  const auto [t, lo, hi] = HWY_NAMESPACE::FindPlace(line, p, seen.areas);
  out.t = t;
  out.lo = lo;
  out.hi = hi;
  return true;
}

}  // namespace tenon
HWY_AFTER_NAMESPACE();
