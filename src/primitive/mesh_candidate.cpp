#include <algorithm>
#include <cmath>

#include "primitive/edge_sign.h"
#include "primitive/mesh_crossings.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// A corner as the line sees it: its place across the line.
struct Corner {
  double x, y;
};

// Twice the area that an edge makes with the line, and a bound on how far it is from the exact line's.
struct EdgeArea {
  double value, error;

  bool is_positive() const { return value > error; }
  bool is_negative() const { return value < -error; }
  bool is_doubtful() const { return !is_positive() && !is_negative(); }
};

EdgeArea edge_area(const Corner& a, const Corner& b, const double (&e)[2]) {
  // Each coordinate is within e; e exceeds four roundings of the coordinates, so twice the first order covers the
  // roundings of the products as well, once the product of two errors is added.
  const double error =
      2 * ((std::fabs(a.x) + std::fabs(b.x)) * e[1] + (std::fabs(a.y) + std::fabs(b.y)) * e[0] + 2 * e[0] * e[1]);
  return {a.x * b.y - a.y * b.x, error};
}

bool misses(double a, double b, double c, double error) {
  return std::min({a, b, c}) > error || std::max({a, b, c}) < -error;
}

// The quotient's interval: where the line crosses the triangle's plane, within the part of the line beside the
// triangle.
void find_place(const MeshLine& line, const std::array<Vec3, 3>& p, const EdgeArea& u, const EdgeArea& v,
                const EdgeArea& w, MeshCandidate& out) {
  const double ta = line.t_of(p[0]), tb = line.t_of(p[1]), tc = line.t_of(p[2]);
  out.lo = std::min({ta, tb, tc});
  out.hi = std::max({ta, tb, tc});
  // First by weights, then corrected by the plane through the triangle, seen from there: so the triangle's own shape
  // counts, and not how far away the origin lies.
  const double sum = u.value + v.value + w.value;
  double t = sum != 0 ? (u.value * ta + v.value * tb + w.value * tc) / sum : 0.5 * out.lo + 0.5 * out.hi;
  t = std::isnan(t) ? 0.5 * out.lo + 0.5 * out.hi : std::clamp(t, out.lo, out.hi);
  out.lo -= line.along_error;
  out.hi += line.along_error;

  const Vec3 along_b = p[1] - p[0], along_c = p[2] - p[0];
  const Vec3 n = cross(along_b, along_c);
  const Vec3 mb = abs(along_b), mc = abs(along_c);
  const Vec3 n_error = gamma(5) * Vec3{mb.y * mc.z + mb.z * mc.y, mb.z * mc.x + mb.x * mc.z, mb.x * mc.y + mb.y * mc.x};
  const Vec3 here = line.origin + t * line.direction;
  const Vec3 from_a = here - p[0];
  const Vec3 here_error = line.origin_error + std::fabs(t) * line.direction_error +
                          gamma(3) * (abs(line.origin) + std::fabs(t) * abs(line.direction) + abs(p[0]));
  const double value = dot(n, from_a), slope = dot(n, line.direction);
  const double value_error =
      dot(abs(n), here_error) + dot(n_error, abs(from_a) + here_error) + gamma(4) * dot(abs(n), abs(from_a));
  const double slope_error = dot(abs(n), line.direction_error) + dot(n_error, abs(line.direction)) +
                             gamma(4) * dot(abs(n), abs(line.direction));
  const double least = std::fabs(slope) - slope_error;
  if (least > 0) {
    const double move = -value / slope;
    // |value* / slope* - value / slope| <= (value_error + |move| slope_error) / least
    const double error = ((value_error + std::fabs(move) * slope_error) / least) * (1 + gamma(8)) +
                         gamma(4) * (std::fabs(move) + std::fabs(t));
    const double place = t + move;
    out.lo = std::max(out.lo, place - error);
    out.hi = std::min(out.hi, place + error);
    t = place;
  }
  // An exact line that passes the triangle by leaves no common part; then any place beside it will do.
  if (!(out.lo <= out.hi)) std::swap(out.lo, out.hi);
  out.t = std::clamp(t, out.lo, out.hi);
}

}  // namespace

bool find_candidate(const MeshLine& line, const TriangleMesh& mesh, std::uint32_t triangle, MeshCandidate& out) {
  const std::array<Vec3, 3> p = mesh.corners(triangle);
  Corner a, b, c;
  line.project(p[0], a.x, a.y);
  line.project(p[1], b.x, b.y);
  line.project(p[2], c.x, c.y);
  if (misses(a.x, b.x, c.x, line.shear_error[0]) || misses(a.y, b.y, c.y, line.shear_error[1])) return false;
  const EdgeArea u = edge_area(b, c, line.shear_error), v = edge_area(c, a, line.shear_error),
                 w = edge_area(a, b, line.shear_error);
  const bool positive = u.is_positive() || v.is_positive() || w.is_positive();
  const bool negative = u.is_negative() || v.is_negative() || w.is_negative();
  if (positive && negative) return false;
  const bool is_certain = (u.is_positive() && v.is_positive() && w.is_positive()) ||
                          (u.is_negative() && v.is_negative() && w.is_negative());
  // What is in doubt must not depend on how generous the boxes are that the triangle was found in.
  if (!is_certain && !MeshSlabs(line).meets({min(p[0], min(p[1], p[2])), max(p[0], max(p[1], p[2]))})) return false;

  out.triangle = triangle;
  const int facing = line.direction[line.along] > 0 ? 1 : -1;
  out.is_certain = is_certain;
  out.is_doubtful = {u.is_doubtful(), v.is_doubtful(), w.is_doubtful()};
  if (out.is_certain) {
    out.is_hit = true;
    out.sense = positive ? facing : -facing;
  } else {
    const int bc = edge_sign(line.origin, line.direction, p[1], p[2]);
    const int ca = edge_sign(line.origin, line.direction, p[2], p[0]);
    const int ab = edge_sign(line.origin, line.direction, p[0], p[1]);
    out.is_hit = bc != 0 && bc == ca && bc == ab;
    const double sum = u.value + v.value + w.value, error = u.error + v.error + w.error;
    out.sense = out.is_hit ? bc : sum > error ? facing : sum < -error ? -facing : 0;
  }
  find_place(line, p, u, v, w, out);
  return true;
}

}  // namespace tenon
