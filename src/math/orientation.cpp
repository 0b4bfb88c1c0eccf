#include "math/orientation.h"

#include <cmath>

#include "math/expansion.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

using Differences = std::array<Difference, 3>;

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto from_d = [&d](const Vec3& p) {
    return Differences{Difference(p.x, d.x), Difference(p.y, d.y), Difference(p.z, d.z)};
  };
  const Differences u = from_d(a), v = from_d(b), w = from_d(c);
  // Six products of three differences, each of two terms.
  Expansion<6 * 8 * 4> sum;
  const auto add = [&sum](const Difference& x, const Difference& y, const Difference& z, double sign) {
    for (const double i : {x.low, x.high}) {
      if (i == 0) continue;
      for (const double j : {y.low, y.high}) {
        if (j == 0) continue;
        for (const double k : {z.low, z.high}) sum.add_product(i, j, sign * k);
      }
    }
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    add(v[i], w[j], u[k], 1);
    add(v[j], w[i], u[k], -1);
  }
  return sum.sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = a - d, v = b - d, w = c - d;
  const double value = dot(u, cross(v, w));
  const Vec3 mu = abs(u), mv = abs(v), mw = abs(w);
  const double terms = dot(mu, Vec3{mv.y * mw.z + mv.z * mw.y, mv.z * mw.x + mv.x * mw.z, mv.x * mw.y + mv.y * mw.x});
  // Three differences round, a product of two, their difference, a product of three and two sums: seven in all, and as
  // many for the terms themselves.
  if (std::fabs(value) > gamma(14) * terms) return value > 0 ? 1 : -1;
  // A difference rounds to 0 only where it is: equal points.
  return terms == 0 ? 0 : exact_orientation(a, b, c, d);
}

int orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Difference bx(b.x, a.x), by(b.y, a.y), cx(c.x, a.x), cy(c.y, a.y);
  const double left = bx.high * cy.high, right = by.high * cx.high;
  const double terms = std::fabs(left) + std::fabs(right);
  // Two differences, a product and the difference of both round: four, and as many for the terms.
  if (std::fabs(left - right) > gamma(8) * terms) return left > right ? 1 : -1;
  if (terms == 0) return 0;
  Expansion<2 * 4 * 2> sum;
  const auto add = [&sum](const Difference& x, const Difference& y, double sign) {
    for (const double i : {x.low, x.high}) {
      for (const double j : {y.low, y.high}) sum.add_product(i, sign * j);
    }
  };
  add(bx, cy, 1);
  add(by, cx, -1);
  return sum.sign();
}

}  // namespace tenon
