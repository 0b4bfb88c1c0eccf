#include "primitive/patch_roots.h"

#include <algorithm>
#include <cmath>

#include "primitive/patch_resultant.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

using Net = BezierNet<double>;

struct Range {
  double least, greatest;

  bool excludes_zero(double error) const { return least > error || greatest < -error; }
  double size() const { return greatest - least; }
};

Range range_of(const Net& net) {
  const auto [least, greatest] = std::minmax_element(net.begin(), net.end());
  return {*least, *greatest};
}

double greatest_of(const Net& net) {
  const Range range = range_of(net);
  return std::max(-range.least, range.greatest);
}

/// The differences of neighbours in u or in v, times 3: the derivative lies between the least and the greatest.
Range slope_of(const Net& net, bool in_u) {
  const std::size_t step = in_u ? 4 : 1;
  Range range{1e300, -1e300};
  for (std::size_t i = 0; i < 16; ++i) {
    if (in_u ? i >= 12 : i % 4 == 3) continue;
    const double slope = 3 * (net[i + step] - net[i]);
    range.least = std::min(range.least, slope);
    range.greatest = std::max(range.greatest, slope);
  }
  return range;
}

/// a·f + b·g, and what its values are off by.
struct Combination {
  Net net;
  double error = 0;

  Combination(double a, const Net& f, double b, const Net& g, double error_each)
      : error((std::fabs(a) + std::fabs(b)) * error_each) {
    double most = 0;
    for (std::size_t i = 0; i < 16; ++i) {
      net[i] = a * f[i] + b * g[i];
      most = std::max(most, std::fabs(a * f[i]) + std::fabs(b * g[i]));
    }
    error += gamma(4) * most;
  }
};

/// A part of the unit square, and the functions over it.
struct Part {
  double u0 = 0, u1 = 1, v0 = 0, v1 = 1;
  Net f, g;
};

class PatchSearch {
 public:
  PatchSearch(const BezierNet<Vec3>& patch, const LocalRay& ray, double size, std::vector<PatchRoot>& roots)
      : patch_(patch), ray_(ray), size_(size), square_(dot(ray.direction, ray.direction)), roots_(roots) {
    const Vec3& d = ray.direction;
    const Vec3 m = abs(d);
    Vec3 axis;
    axis[m.x <= m.y && m.x <= m.z ? 0 : m.y <= m.z ? 1 : 2] = 1;
    const Vec3 n1 = normalize(cross(d, axis)), n2 = normalize(cross(d, n1));
    double farthest = 0, reach = 0;
    for (std::size_t i = 0; i < 16; ++i) {
      const Vec3 p = patch[i] - ray.origin;
      whole_.f[i] = dot(n1, p);
      whole_.g[i] = dot(n2, p);
      farthest = std::max(farthest, length(p));
      reach = std::max(reach, length(abs(patch[i]) + abs(ray.origin)));
    }
    // Of the ray, of the planes' directions, and of the control points, which splines have to compute.
    error_ = length(ray.origin_error) + farthest / std::sqrt(square_) * length(ray.direction_error) +
             gamma(24) * farthest + gamma(16) * reach;
  }

  void search(PatchMethod method) {
    if (!std::isfinite(error_)) return;
    subdivides_ = method == PatchMethod::subdivision;
    if (method == PatchMethod::resultant) {
      search_strips();
    } else {
      search(whole_, 0);
    }
  }

 private:
  // In u and v together there are not more bits than this to tell parts apart by.
  static constexpr int most_depth = 96;
  // A patch that is seen edge on is nowhere certain; after so many parts, nothing more of it will show.
  static constexpr int most_parts = 4096;

  // The u for which the resultant may be zero.
  void search_strips() {
    thread_local RootPieces pieces;
    isolate_by_resultant(whole_.f, whole_.g, error_, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].kind == RootPiece::Kind::empty) continue;
      Part strip;
      strip.u0 = pieces[i].begin;
      while (i + 1 < pieces.size() && pieces[i + 1].kind != RootPiece::Kind::empty) ++i;
      strip.u1 = pieces[i].end;
      strip.f = restricted(whole_.f, true, strip.u0, strip.u1);
      strip.g = restricted(whole_.g, true, strip.u0, strip.u1);
      search(strip, 1);
    }
  }

  void search(const Part& part, int depth) {
    if (++parts_ > most_parts) return;
    // Each halving takes three roundings of what is no larger than the whole.
    const double error = error_ + gamma(3 * depth + 12) * std::max(greatest_of(whole_.f), greatest_of(whole_.g));
    const Range f = range_of(part.f), g = range_of(part.g);
    if (f.excludes_zero(error) || g.excludes_zero(error)) return;
    if (subdivides_ && std::max(f.size(), g.size()) <= size_ && depth_size(part) <= size_) return add_part(part);
    if (!subdivides_ && judge(part, error)) return;
    const double u_size = slope_size(part, true), v_size = slope_size(part, false);
    if (depth == most_depth || !(std::max(u_size, v_size) > 0)) return add_part(part);
    const bool in_u = u_size >= v_size;
    const double middle = in_u ? 0.5 * part.u0 + 0.5 * part.u1 : 0.5 * part.v0 + 0.5 * part.v1;
    Part first = part, second = part;
    (in_u ? first.u1 : first.v1) = middle;
    (in_u ? second.u0 : second.v0) = middle;
    halve(part.f, in_u, first.f, second.f);
    halve(part.g, in_u, first.g, second.g);
    search(first, depth + 1);
    search(second, depth + 1);
  }

  static double slope_size(const Part& part, bool in_u) {
    const Range f = slope_of(part.f, in_u), g = slope_of(part.g, in_u);
    return std::max({std::fabs(f.least), std::fabs(f.greatest), std::fabs(g.least), std::fabs(g.greatest)});
  }

  // How far the part reaches along the line, about.
  double depth_size(const Part& part) const {
    double least = 1e300, greatest = -1e300;
    for (const double u : {part.u0, part.u1}) {
      for (const double v : {part.v0, part.v1}) {
        const double at = dot(evaluate(patch_, u, v).value, ray_.direction) / std::sqrt(square_);
        least = std::min(least, at);
        greatest = std::max(greatest, at);
      }
    }
    return greatest - least;
  }

  // Whether the part is done with: it has no root, or one that has been found.
  bool judge(const Part& part, double error) {
    // The mean slopes over the part are inverted, so that of F and G the matrix of slopes is near the identity.
    const auto mean = [](const Net& net, bool in_u) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += in_u ? net[12 + k] - net[k] : net[4 * k + 3] - net[4 * k];
      return sum / 4;
    };
    const double fu = mean(part.f, true), fv = mean(part.f, false), gu = mean(part.g, true), gv = mean(part.g, false);
    const double determinant = fu * gv - fv * gu;
    if (determinant == 0 || !std::isfinite(1 / determinant)) return false;
    const Combination F(gv / determinant, part.f, -fv / determinant, part.g, error);
    const Combination G(-gu / determinant, part.f, fu / determinant, part.g, error);
    if (range_of(F.net).excludes_zero(F.error) || range_of(G.net).excludes_zero(G.error)) return true;
    // Six errors in a difference of two, times 3.
    const auto aside = [](const Range& r) { return std::max(-r.least, r.greatest); };
    if (!(slope_of(F.net, true).least - 6 * F.error > aside(slope_of(F.net, false)) + 6 * F.error)) return false;
    if (!(slope_of(G.net, false).least - 6 * G.error > aside(slope_of(G.net, true)) + 6 * G.error)) return false;
    return find_root(part, F, G);
  }

  // Newton's method in the part's own coordinates.
  bool find_root(const Part& part, const Combination& F, const Combination& G) {
    constexpr int most_steps = 16;
    double u = 0.5, v = 0.5, moved = 0;
    for (int step = 0; step < most_steps; ++step) {
      const PatchPoint<double> f = evaluate(F.net, u, v), g = evaluate(G.net, u, v);
      const double determinant = f.by_u * g.by_v - f.by_v * g.by_u;
      const double du = (f.value * g.by_v - f.by_v * g.value) / determinant;
      const double dv = (f.by_u * g.value - f.value * g.by_u) / determinant;
      u -= du;
      v -= dv;
      if (!(std::fabs(u - 0.5) <= 1 && std::fabs(v - 0.5) <= 1)) return false;
      moved = std::max(std::fabs(du), std::fabs(dv));
      if (moved <= 4 * unit_roundoff) break;
    }
    // The slopes are within a factor of two of the identity's.
    const double u_slip = 4 * (F.error + G.error) + gamma(8), v_slip = u_slip;
    // Beside the part they need not be, and Newton's method may run in a circle there.
    if (!(moved <= u_slip)) return false;
    if (u < -u_slip || u > 1 + u_slip || v < -v_slip || v > 1 + v_slip) return true;
    add_root(part.u0 + u * (part.u1 - part.u0), part.v0 + v * (part.v1 - part.v0), 0, 0);
    return true;
  }

  void add_part(const Part& part) {
    add_root(0.5 * part.u0 + 0.5 * part.u1, 0.5 * part.v0 + 0.5 * part.v1, part.u1 - part.u0, part.v1 - part.v0);
  }

  // u and v are known to within half of these slips, and by how far the line misses the place.
  void add_root(double u, double v, double u_slip, double v_slip) {
    u = std::clamp(u, 0.0, 1.0);
    v = std::clamp(v, 0.0, 1.0);
    const PatchPoint<double> f = evaluate(whole_.f, u, v), g = evaluate(whole_.g, u, v);
    const PatchPoint<Vec3> at = evaluate(patch_, u, v);
    const Vec3 p = at.value - ray_.origin;
    PatchRoot root;
    root.u = u;
    root.v = v;
    root.t = dot(p, ray_.direction) / square_;
    if (u_slip == 0 && v_slip == 0) {
      const double error = std::max(std::fabs(f.value), std::fabs(g.value)) + error_ +
                           gamma(24) * std::max(greatest_of(whole_.f), greatest_of(whole_.g));
      const double determinant = std::fabs(f.by_u * g.by_v - f.by_v * g.by_u);
      // Twice the first order covers the curvature, for the slopes change by less than half over the part.
      u_slip = 2 * (std::fabs(f.by_v) + std::fabs(g.by_v)) * error / determinant;
      v_slip = 2 * (std::fabs(f.by_u) + std::fabs(g.by_u)) * error / determinant;
    }
    const double speed = std::sqrt(square_);
    const double place = length(ray_.origin_error) + std::fabs(root.t) * length(ray_.direction_error) +
                         gamma(16) * length(abs(at.value) + abs(ray_.origin));
    double bound =
        (std::fabs(dot(at.by_u, ray_.direction)) * u_slip + std::fabs(dot(at.by_v, ray_.direction)) * v_slip) /
            square_ +
        place / speed;
    // What is seen edge on lies anywhere along itself.
    const double most = (length(at.by_u) + length(at.by_v)) / speed;
    if (!(bound <= most)) bound = most + place / speed;
    root.lo = root.t - bound;
    root.hi = root.t + bound;
    root.against = dot(patch_normal(patch_, u, v), ray_.direction) < 0;
    if (std::isfinite(root.t) && std::isfinite(bound)) roots_.push_back(root);
  }

  const BezierNet<Vec3>& patch_;
  const LocalRay& ray_;
  double size_, square_;
  Part whole_;
  double error_ = 0;
  bool subdivides_ = false;
  int parts_ = 0;
  std::vector<PatchRoot>& roots_;
};

}  // namespace

void find_patch_roots(const BezierNet<Vec3>& patch, const LocalRay& ray, PatchMethod method, double size,
                      std::vector<PatchRoot>& roots) {
  PatchSearch(patch, ray, size, roots).search(method);
}

Vec3 patch_normal(const BezierNet<Vec3>& patch, double u, double v) {
  // Towards the middle, from 2^-20 of the way on, until u and v make a plane.
  for (double step = 0; step <= 1; step = step == 0 ? 0x1p-20 : 4 * step) {
    const PatchPoint<Vec3> p = evaluate(patch, u + step * (0.5 - u), v + step * (0.5 - v));
    const Vec3 n = cross(p.by_u, p.by_v);
    const double size = length(p.by_u) * length(p.by_v);
    double extent = 0;
    for (const Vec3& c : patch) extent = std::max(extent, length(c - patch[0]));
    if (length(n) > 0x1p-40 * size && size > 0x1p-60 * extent * extent) return n;
  }
  return {0, 0, 1};
}

}  // namespace tenon
