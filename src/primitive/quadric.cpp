#include "primitive/quadric.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "primitive/box_clip.h"
#include "primitive/check.h"
#include "primitive/polish_root.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// Of the farthest point of a root's interval from the expansion point.
double distance_of(const BoundedRoot& root) {
  return std::max(std::fabs(root.lo), std::fabs(root.hi));
}

}  // namespace

void Quadric::prepare() {
  const QuadricCoefficients& q = coefficients;
  square_ = {q[0], q[1], q[2]};
  mixed_ = 0.5 * Vec3{q[5], q[4], q[3]};
  linear_ = 0.5 * Vec3{q[6], q[7], q[8]};
}

std::string Quadric::check() const {
  double largest = 0;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (!std::isfinite(coefficients[i])) return "coefficient " + std::to_string(i) + " of quadric is not finite";
    if (i < 9) largest = std::max(largest, std::fabs(coefficients[i]));
  }
  if (largest == 0) return "quadric with a polynomial that is constant bounds nothing";
  if (std::string problem = check_lengths(name, {{"the largest coefficient", largest}}); !problem.empty())
    return problem;
  return box == Box3::everything() ? std::string() : check_box(name, box);
}

double Quadric::support(const Vec3& n) const {
  if (n == Vec3{}) return 0;
  return box == Box3::everything() ? std::numeric_limits<double>::infinity() : box_support(box, n);
}

Vec3 Quadric::times_m(const Vec3& v) const {
  return {square_.x * v.x + mixed_.z * v.y + mixed_.y * v.z, mixed_.z * v.x + square_.y * v.y + mixed_.x * v.z,
          mixed_.y * v.x + mixed_.x * v.y + square_.z * v.z};
}

Vec3 Quadric::times_m_size(const Vec3& v) const {
  const Vec3 s = abs(square_), m = abs(mixed_);
  return {s.x * v.x + m.z * v.y + m.y * v.z, m.z * v.x + s.y * v.y + m.x * v.z, m.y * v.x + m.x * v.y + s.z * v.z};
}

Quadric::Expansion Quadric::expand(const LocalRay& ray, double t, double reach) const {
  const Vec3& d = ray.direction;
  const Vec3 p = ray.origin + t * d;
  Expansion e;
  e.turn = times_m(d);
  e.slope = times_m(p) + linear_;
  e.a = dot(d, e.turn);
  e.b = dot(d, e.slope);
  e.c = dot(p, e.slope + linear_) + coefficients[9];
  const Vec3 d_size = abs(d), p_size = abs(p), g_size = abs(linear_);
  e.a_size = dot(d_size, times_m_size(d_size));
  e.b_size = dot(d_size, times_m_size(p_size) + g_size);
  e.c_size = dot(p_size, times_m_size(p_size) + 2 * g_size) + std::fabs(coefficients[9]);
  // The product and the sum round once each.
  e.place_error = ray.origin_error + reach * ray.direction_error + gamma(1) * (std::fabs(t) * d_size + p_size);
  return e;
}

// q* differs by 2 (M p + g)·e + e·M e from where the place is off by e; and by the roundings, at most nine a term.
double Quadric::error_at(const Expansion& e, double away) const {
  const Vec3& pe = e.place_error;
  const double rounding = e.c_size + away * (2 * e.b_size + away * e.a_size);
  return 2 * dot(abs(e.slope) + away * abs(e.turn), pe) + dot(pe, times_m_size(pe)) + gamma(12) * rounding;
}

// With the error that holds as far away as the interval of one root reaches: a cluster may be wider than its distance.
// A line that all but lies in the surface is nowhere certain, and the root anywhere.
QuadraticSet Quadric::solve_for(BoundedRoot QuadraticSet::*root, const LocalRay& ray, double at, double away) const {
  constexpr int most_rounds = 16;
  QuadraticSet set;
  for (int round = 0; round < most_rounds; ++round) {
    const Expansion e = expand(ray, at, std::fabs(at) + away);
    const double error = error_at(e, away);
    if (!std::isfinite(error)) break;
    set = solve_quadratic(e.a, e.b, e.c, error);
    const double reach = distance_of(set.*root);
    if (!(reach > away) || !std::isfinite((set.*root).t)) return set;
    away = 2 * reach;
  }
  (set.*root).lo = -std::numeric_limits<double>::infinity();
  (set.*root).hi = std::numeric_limits<double>::infinity();
  return set;
}

// Each root by the error at its own distance from the expansion point, for one of them may lie far away. A cluster of
// both is solved again around its own place, as long as that narrows it down: at the tip of a cone, where all terms
// vanish, one of width sqrt(u) shrinks to u.
QuadraticSet Quadric::solve(const LocalRay& ray, double middle) const {
  constexpr int most_rounds = 4;
  double at = middle, last_width = std::numeric_limits<double>::infinity();
  for (int round = 0;; ++round) {
    const Expansion e = expand(ray, at, std::fabs(at));
    QuadraticSet set = solve_quadratic(e.a, e.b, e.c, 0);
    const bool has_roots = set.shape == QuadraticSet::Shape::between || set.shape == QuadraticSet::Shape::outside;
    // What misses zero does so least at the vertex, if there is one.
    const double vertex = std::isfinite(e.b / e.a) ? std::fabs(e.b / e.a) : 0;
    const double first = has_roots ? distance_of(set.first) : vertex;
    const double second = has_roots ? distance_of(set.second) : vertex;
    const auto near = first <= second ? &QuadraticSet::first : &QuadraticSet::second;
    const auto far = first <= second ? &QuadraticSet::second : &QuadraticSet::first;
    set = solve_for(far, ray, at, std::isfinite(std::max(first, second)) ? std::max(first, second) : 0);
    if (set.shape == QuadraticSet::Shape::none || set.shape == QuadraticSet::Shape::all) return set;
    const bool clustered = set.first.hi >= set.second.lo;
    if (!clustered) set.*near = solve_for(near, ray, at, std::min(first, second)).*near;

    const double width = set.second.hi - set.first.lo;
    if (!clustered || !(width < 0.5 * last_width) || round == most_rounds) {
      for (BoundedRoot* root : {&set.first, &set.second})
        *root = lateral_end(*root, at, surface);  // NOLINT(cppcoreguidelines-slicing): the face is set apart
      return set;
    }
    last_width = width;
    at += 0.5 * set.first.lo + 0.5 * set.second.hi;
  }
}

QuadraticSet Quadric::solve_from_surface(const LocalRay& ray) const {
  using Shape = QuadraticSet::Shape;
  const Expansion e = expand(ray, 0, 0);
  if (e.a == 0 && e.b == 0) return {Shape::all, {}, {}};
  const Vec3 &d_error = ray.direction_error, &p_error = e.place_error;
  const double a_error = 2 * dot(abs(e.turn), d_error) + dot(d_error, times_m_size(d_error)) + gamma(12) * e.a_size;
  const double b_error = dot(abs(e.slope), d_error) + dot(abs(e.turn), p_error) + dot(d_error, times_m_size(p_error)) +
                         gamma(12) * e.b_size;
  const BoundedRoot here, other = solve_deflated(e.a, e.b, a_error, b_error);
  const Shape shape = e.a >= 0 ? Shape::between : Shape::outside;
  return other.t >= 0 ? QuadraticSet{shape, here, other} : QuadraticSet{shape, other, here};
}

void Quadric::spans(const LocalRay& ray, Spans& out) const {
  using Shape = QuadraticSet::Shape;
  Chord chord;
  const bool is_clipped = box != Box3::everything();
  if (is_clipped && !clip_box(ray, box, box_faces, chord)) return;
  if (chord.enter.lo > chord.leave.hi) return;

  const bool from_surface = ray.on_face == static_cast<int>(surface);
  const double middle = is_clipped ? 0.5 * chord.enter.t + 0.5 * chord.leave.t : 0;
  QuadraticSet set = from_surface ? solve_from_surface(ray) : solve(ray, std::isfinite(middle) ? middle : 0);
  if (set.shape == Shape::none) return;
  if (set.shape == Shape::all) {
    emit_chord(chord, out);
    return;
  }
  for (BoundedRoot* root : {&set.first, &set.second}) polish_root(*this, ray, *root);
  // Of the two roots of a ray that starts on the surface, one is the start.
  const auto end_of = [from_surface](const BoundedRoot& root) {
    return End{root, surface, from_surface && root.t == 0 && root.lo == 0 && root.hi == 0};
  };
  const End first = end_of(set.first), second = end_of(set.second);
  if (set.shape == Shape::between) {
    emit_chord({later(chord.enter, first), earlier(chord.leave, second)}, out);
  } else {
    emit_chords({chord.enter, earlier(chord.leave, first)}, {later(chord.enter, second), chord.leave}, out);
  }
}

// q(c + δ) = q(c) + 2 (M c + g)·δ + δ·M δ.
Region Quadric::classify(const LocalBox& region) const {
  if (!box.overlaps(region.bounds)) return Region::outside;
  const Vec3& c = region.center;
  const Vec3 slope = times_m(c) + linear_;
  const double value = dot(c, slope + linear_) + coefficients[9];
  const Vec3 offset = abs(region.half_edges[0]) + abs(region.half_edges[1]) + abs(region.half_edges[2]) + region.error;
  double radius = 2 * dot(abs(slope), region.error) + dot(offset, times_m_size(offset));
  for (const Vec3& half_edge : region.half_edges) radius += 2 * std::fabs(dot(slope, half_edge));
  const Vec3 most = abs(c) + offset;
  // No term takes more than twelve roundings.
  radius += gamma(16) * (dot(most, times_m_size(most) + 2 * abs(linear_)) + std::fabs(coefficients[9]));
  if (value - radius > 0) return Region::outside;
  return value + radius < 0 && box.contains(region.bounds) ? Region::inside : Region::straddles;
}

Vec3 Quadric::normal(const Vec3& point, std::uint32_t face) const {
  if (face >= box_faces) return box_face_normal(face - box_faces);
  const Vec3 n = times_m(point) + linear_;
  // At the tip of a cone any way is as good as another.
  return n == Vec3{} ? Vec3{0, 0, 1} : n;
}

}  // namespace tenon
