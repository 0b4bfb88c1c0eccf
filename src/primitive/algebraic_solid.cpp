#include "primitive/algebraic_solid.h"

#include <algorithm>
#include <cmath>

#include "primitive/box_clip.h"
#include "primitive/box_tests.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

/// f / s, for a line that is known to lie on the surface at s = 0: its constant term is 0.
template <int N>
BoundedPolynomial<N> deflated(const BoundedPolynomial<N>& f) {
  Polynomial<N> p, error;
  for (std::size_t i = 1; i < p.count; ++i) {
    p.c[i - 1] = f.p.c[i];
    error.c[i - 1] = f.coefficient_error.c[i];
  }
  return {p, error};
}

/// The parts of a chord between roots where the function is negative.
class NegativeParts {
 public:
  NegativeParts(const Chord& chord, bool starts_negative, Spans& out)
      : chord_(chord), negative_(starts_negative), begin_(out.size()), out_(out) {}

  void cross(const End& at) {
    if (negative_) {
      emit_chord({later(chord_.enter, from_), earlier(chord_.leave, at)}, out_);
    } else {
      from_ = at;
    }
    negative_ = !negative_;
  }
  void finish() {
    if (negative_) emit_chord({later(chord_.enter, from_), chord_.leave}, out_);
    put_in_order(begin_, out_);
  }

 private:
  const Chord& chord_;
  bool negative_;
  std::size_t begin_;
  Spans& out_;
  End from_ = Chord{}.enter;
};

template <int N>
bool is_finite(const BoundedPolynomial<N>& f) {
  double sum = 0;
  for (std::size_t i = 0; i < f.p.count; ++i) sum += 0 * f.p.c[i] + 0 * f.coefficient_error.c[i];
  return sum == 0;
}

}  // namespace

template <int N>
void AlgebraicSolid::spans_of_degree(const LocalRay& ray, const Chord& chord, Spans& out) const {
  thread_local RootPieces pieces;
  thread_local std::vector<CrossingRoot> roots;
  const bool from_surface = ray.on_face == static_cast<int>(surface);
  // A sixteenth beyond the chord on both sides, so that roots near its ends lie within.
  const double begin = chord.enter.lo, end = chord.leave.hi, margin = (end - begin) / 16;
  double moved = 0.5 * begin + 0.5 * end, scale = 0.5 * (end - begin) + margin, from = -1, to = 1;
  if (from_surface) {
    moved = 0;
    const double least = std::min(begin - margin, 0.0), most = std::max(end + margin, 0.0);
    scale = std::max(-least, most);
    from = least / scale;
    to = most / scale;
  }
  BoundedPolynomial<N> f = f_.along<N>(ray, moved, scale);
  if (!is_finite(f)) return;
  if (from_surface) f = deflated(f);
  const bool negative = solve_by_isolation(f, from, to, isolation_, refinement_, pieces, roots);

  // The start of a ray on the surface is one more root, and before it f has the other sign than f / s.
  bool start_is_due = from_surface;
  NegativeParts parts(chord, negative != from_surface, out);
  const auto cross_start = [&] {
    parts.cross({{}, surface, true});
    start_is_due = false;
  };
  for (const CrossingRoot& root : roots) {
    if (start_is_due && root.t >= 0) cross_start();
    // Widened by the rounding of the product.
    const BoundedRoot scaled{root.t * scale, root.lo * scale - unit_roundoff * std::fabs(root.lo * scale),
                             root.hi * scale + unit_roundoff * std::fabs(root.hi * scale)};
    parts.cross(lateral_end(scaled, moved, surface));
  }
  if (start_is_due) cross_start();
  parts.finish();
}

void AlgebraicSolid::spans(const LocalRay& ray, Spans& out) const {
  Chord chord;
  if (!clip_box(ray, box_, box_faces, chord)) return;
  if (!(chord.enter.lo < chord.leave.hi) || !std::isfinite(chord.enter.lo) || !std::isfinite(chord.leave.hi)) return;
  const int n = f_.degree();
  if (n <= 2) return spans_of_degree<2>(ray, chord, out);
  if (n <= 4) return spans_of_degree<4>(ray, chord, out);
  if (n <= 6) return spans_of_degree<6>(ray, chord, out);
  if (n <= 8) return spans_of_degree<8>(ray, chord, out);
  spans_of_degree<12>(ray, chord, out);
}

namespace {

/// One of the eight parts that a box is halved into.
LocalBox eighth(const LocalBox& box, int i) {
  LocalBox part = box;
  Vec3 reach;
  for (std::size_t k = 0; k < 3; ++k) {
    part.half_edges[k] = 0.5 * box.half_edges[k];
    part.center += ((i >> k & 1) != 0 ? 1.0 : -1.0) * part.half_edges[k];
    reach += abs(part.half_edges[k]);
  }
  // Three sums have moved the centre.
  part.error += gamma(4) * (abs(box.center) + 2 * reach);
  part.bounds = {part.center - reach - part.error, part.center + reach + part.error};
  return part;
}

int sign_of(const Extent& range) {
  return range.least() > 0 ? 1 : range.greatest() < 0 ? -1 : 0;
}

}  // namespace

// In an eighth of the box, what the bounds take too much is a quarter.
Region AlgebraicSolid::classify(const LocalBox& box) const {
  if (!box_.overlaps(box.bounds)) return Region::outside;
  const Extent range = f_.range(box);
  int sign = sign_of(range);
  if (sign == 0 && std::fabs(range.center) > 0.25 * range.radius) {
    sign = range.center > 0 ? 1 : -1;
    for (int i = 0; i < 8 && sign != 0; ++i) {
      if (sign_of(f_.range(eighth(box, i))) != sign) sign = 0;
    }
  }
  if (sign > 0) return Region::outside;
  return sign < 0 && box_.contains(box.bounds) ? Region::inside : Region::straddles;
}

Vec3 AlgebraicSolid::normal(const Vec3& point, std::uint32_t face) const {
  if (face >= box_faces) return box_face_normal(face - box_faces);
  const Vec3 gradient = f_.gradient(point);
  // At a singular point any way is as good as another.
  return gradient == Vec3{} ? Vec3{0, 0, 1} : gradient;
}

}  // namespace tenon
