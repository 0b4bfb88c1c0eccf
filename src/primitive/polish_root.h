#pragma once

#include <algorithm>
#include <cmath>

#include "math/bounded_root.h"
#include "primitive/local_ray.h"
#include "tenon/math/rounding.h"

namespace tenon {

/// Narrows the interval of a simple root of a quadric with the errors of its own place: near the tip of a cone they are
/// much smaller than those of the whole window.
///
/// Expand at the root: one Newton step s = -c / 2b leaves a residual of a s², and within β of there q* has the sign of
/// ±2 b β as soon as 2 |b| β > error + |a| (|s| + β)². Since (|s| + β)² <= 2 s² + 2 β², and with |a| β <= |b| / 8,
/// β = (error + 2 |a| s²) / (1.75 |b|) will do.
///
/// @param quadric  has expand(ray, t, reach) and error_at(expansion, away), as RevolvedQuadric. It may have
///                 is_settled(expansion), too: where that is so, t stays where it is, and the interval around it.
template <class Quadric>
void polish_root(const Quadric& quadric, const LocalRay& ray, BoundedRoot& root) {
  const double away = std::max(root.hi - root.t, root.t - root.lo);
  if (!(std::isfinite(root.t) && std::isfinite(away) && away > 0)) return;
  const auto e = quadric.expand(ray, root.t, std::fabs(root.t) + away);
  const double slope_here = std::fabs(e.b);
  const double step = -e.c / (2 * e.b);
  const double bound = (quadric.error_at(e, away) + 2 * std::fabs(e.a) * step * step) / (1.75 * slope_here);
  const double t = root.t + step;
  if (!(std::fabs(e.a) * bound <= slope_here / 8) || !(std::fabs(step) <= away) || !(bound < away)) return;
  const double total = bound + gamma(3) * std::fabs(t);
  bool is_settled = false;
  if constexpr (requires { quadric.is_settled(e); }) is_settled = quadric.is_settled(e);
  if (!is_settled) root.t = t;
  root.lo = std::max(root.lo, std::min(t - total, root.t));
  root.hi = std::min(root.hi, std::max(t + total, root.t));
}

}  // namespace tenon
