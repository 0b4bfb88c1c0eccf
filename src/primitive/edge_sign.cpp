#include "primitive/edge_sign.h"

#include <array>
#include <cmath>

#include "math/expansion.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// edge_sign() adds six products of three factors, two of them of two terms each; each product has four terms.
using EdgeSum = Expansion<96>;

void add_product(EdgeSum& sum, const Difference& a, const Difference& b, double c) {
  for (const double x : {a.low, a.high}) {
    for (const double y : {b.low, b.high}) sum.add_product(x, y, c);
  }
}

int exact_sign(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b) {
  const auto from_origin = [&origin](const Vec3& p) {
    return std::array{Difference(p.x, origin.x), Difference(p.y, origin.y), Difference(p.z, origin.z)};
  };
  const auto from_a = from_origin(a), from_b = from_origin(b);
  EdgeSum sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double d = direction[static_cast<int>(k)];
    add_product(sum, from_a[i], from_b[j], d);
    add_product(sum, from_a[j], from_b[i], -d);
  }
  return sum.sign();
}

// Component i of (a - b) × direction.
int cross_sign(const Vec3& direction, const Vec3& a, const Vec3& b, int i) {
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  const Difference along_j(a[j], b[j]), along_k(a[k], b[k]);
  EdgeSum sum;
  for (const double x : {along_j.low, along_j.high}) sum.add_product(x, direction[k]);
  for (const double x : {along_k.low, along_k.high}) sum.add_product(x, -direction[j]);
  return sum.sign();
}

}  // namespace

int edge_sign(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b) {
  const Vec3 from_a = a - origin, from_b = b - origin;
  const double value = dot(direction, cross(from_a, from_b));
  const Vec3 m = abs(from_a), n = abs(from_b);
  const double terms = dot(abs(direction), Vec3{m.y * n.z + m.z * n.y, m.z * n.x + m.x * n.z, m.x * n.y + m.y * n.x});
  // Two roundings of differences, one of the product of two, one of their difference, one of the product of three, and
  // two of the sum; as many again cover the rounding of `terms` itself.
  if (std::fabs(value) > gamma(14) * terms) return value > 0 ? 1 : -1;
  if (const int sign = exact_sign(origin, direction, a, b)) return sign;
  // Moving the origin by v changes the value by v·((a - b) × direction). v is one axis, then another; with the
  // direction's largest component along the third, the three span space.
  const Vec3 size = abs(direction);
  const int largest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (const int sign = cross_sign(direction, a, b, (largest + 1) % 3)) return sign;
  return cross_sign(direction, a, b, (largest + 2) % 3);
}

}  // namespace tenon
