#include "primitive/polynomial3.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/math/rounding.h"

namespace tenon {

Polynomial3::Polynomial3(const PolynomialTerms& terms, double relative_error) {
  for (const PolynomialTerm& t : terms) {
    if (t.a != 0) degree_ = std::max(degree_, t.i + t.j + t.k);
  }
  a_.assign(side() * side() * side(), 0);
  error_ = a_;
  for (const PolynomialTerm& t : terms) {
    if (t.a == 0) continue;
    const std::size_t at =
        index(static_cast<std::size_t>(t.i), static_cast<std::size_t>(t.j), static_cast<std::size_t>(t.k));
    const double sum = a_[at] + t.a;
    error_[at] += (std::fabs(sum_error(a_[at], t.a, sum)) + relative_error * std::fabs(t.a)) * (1 + gamma(4));
    a_[at] = sum;
  }
}

template <class Sum>
Sum Polynomial3::evaluate(const Sum& zero) const {
  const std::size_t n = static_cast<std::size_t>(degree_);
  Sum over_x = zero;
  for (std::size_t i = n + 1; i-- > 0;) {
    Sum over_y = zero;
    for (std::size_t j = n - i + 1; j-- > 0;) {
      Sum over_z = zero;
      for (std::size_t k = n - i - j + 1; k-- > 0;) {
        over_z.multiply(2);
        over_z.add(a_[index(i, j, k)], error_[index(i, j, k)]);
      }
      over_y.multiply(1);
      over_y.add(over_z);
    }
    over_x.multiply(0);
    over_x.add(over_y);
  }
  return over_x;
}

namespace {

struct ValueAt {
  const Vec3* p;
  double v = 0;

  void multiply(int axis) { v *= (*p)[axis]; }
  void add(double a, double) { v += a; }
  void add(const ValueAt& other) { v += other.v; }
};

struct SizeAt {
  const Vec3* p;
  bool of_errors;
  double v = 0;

  void multiply(int axis) { v *= std::fabs((*p)[axis]); }
  void add(double a, double e) { v += of_errors ? e : std::fabs(a); }
  void add(const SizeAt& other) { v += other.v; }
};

struct GradientAt {
  const Vec3* p;
  double v = 0;
  Vec3 g;

  void multiply(int axis) {
    const double x = (*p)[axis];
    g = x * g;
    g[axis] += v;
    v *= x;
  }
  void add(double a, double) { v += a; }
  void add(const GradientAt& other) {
    v += other.v;
    g += other.g;
  }
};

/// A coordinate along the line, o + s d, and what the exact one may differ by.
struct Coordinate {
  double o, d, o_error, d_error;
};

/// Running error analysis (Higham, section 3.3): a polynomial in s, and a bound on the error of each coefficient.
template <int N>
struct PolynomialAlong {
  const std::array<Coordinate, 3>* line;
  std::size_t count = 0;  // coefficients that are not zero
  std::array<double, static_cast<std::size_t>(N) + 1> c{}, e{};

  void multiply(int axis) {
    const auto& [o, d, oe, de] = (*line)[static_cast<std::size_t>(axis)];
    if (count == 0) return;
    const double o_most = std::fabs(o) + oe, d_most = std::fabs(d) + de;
    // From the top, so that the coefficient below is still the old one.
    if (count < c.size()) ++count;
    for (std::size_t m = count; m-- > 0;) {
      const double same = c[m] * o, from_below = m > 0 ? c[m - 1] * d : 0;
      const double sum = same + from_below;
      const double carried =
          e[m] * o_most + std::fabs(c[m]) * oe + (m > 0 ? e[m - 1] * d_most + std::fabs(c[m - 1]) * de : 0);
      e[m] = carried + unit_roundoff * (std::fabs(same) + std::fabs(from_below) + std::fabs(sum));
      c[m] = sum;
    }
  }
  void add(double a, double a_error) {
    if (a == 0 && a_error == 0) return;
    count = std::max(count, std::size_t{1});
    c[0] += a;
    e[0] += a_error + unit_roundoff * std::fabs(c[0]);
  }
  void add(const PolynomialAlong& other) {
    count = std::max(count, other.count);
    for (std::size_t m = 0; m < other.count; ++m) {
      c[m] += other.c[m];
      e[m] += other.e[m] + unit_roundoff * std::fabs(c[m]);
    }
  }
};

}  // namespace

double Polynomial3::value(const Vec3& p) const {
  return evaluate(ValueAt{&p}).v;
}

double Polynomial3::size(const Vec3& p) const {
  return evaluate(SizeAt{&p, false}).v;
}

Vec3 Polynomial3::gradient(const Vec3& p) const {
  return evaluate(GradientAt{&p, 0, {}}).g;
}

template <int N>
BoundedPolynomial<N> Polynomial3::along(const LocalRay& ray, double moved, double scale) const {
  const Vec3 p = ray.origin + moved * ray.direction, d = scale * ray.direction;
  const Vec3 p_error = ray.origin_error + std::fabs(moved) * ray.direction_error +
                       gamma(2) * (std::fabs(moved) * abs(ray.direction) + abs(p));
  const Vec3 d_error = scale * ray.direction_error + gamma(1) * abs(d);
  std::array<Coordinate, 3> line{};
  for (int axis = 0; axis < 3; ++axis) {
    line[static_cast<std::size_t>(axis)] = {p[axis], d[axis], p_error[axis], d_error[axis]};
  }
  const auto f = evaluate(PolynomialAlong<N>{&line});
  // The bounds themselves have been rounded: by six operations in each of at most N multiplications and 3 N additions.
  Polynomial<N> value{f.c}, error{f.e};
  for (double& e : error.c) e *= 1 + gamma(24 * N);
  return {value, error};
}

template BoundedPolynomial<2> Polynomial3::along(const LocalRay&, double, double) const;
template BoundedPolynomial<4> Polynomial3::along(const LocalRay&, double, double) const;
template BoundedPolynomial<6> Polynomial3::along(const LocalRay&, double, double) const;
template BoundedPolynomial<8> Polynomial3::along(const LocalRay&, double, double) const;
template BoundedPolynomial<12> Polynomial3::along(const LocalRay&, double, double) const;

// Taylor's expansion around the box's centre: the terms of first order along the box's own edges, all higher ones by
// the largest offsets.
Extent Polynomial3::range(const LocalBox& box) const {
  const std::size_t n = static_cast<std::size_t>(degree_);
  thread_local std::vector<double> c;
  c = a_;
  const Vec3& center = box.center;
  // Repeated synthetic division along each axis in turn.
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; i + j <= n; ++j) {
      for (std::size_t from = 0; from < n - i - j; ++from) {
        for (std::size_t k = n - i - j; k-- > from;) c[index(i, j, k)] += center.z * c[index(i, j, k + 1)];
      }
    }
  }
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t k = 0; i + k <= n; ++k) {
      for (std::size_t from = 0; from < n - i - k; ++from) {
        for (std::size_t j = n - i - k; j-- > from;) c[index(i, j, k)] += center.y * c[index(i, j + 1, k)];
      }
    }
  }
  for (std::size_t j = 0; j <= n; ++j) {
    for (std::size_t k = 0; j + k <= n; ++k) {
      for (std::size_t from = 0; from < n - j - k; ++from) {
        for (std::size_t i = n - j - k; i-- > from;) c[index(i, j, k)] += center.x * c[index(i + 1, j, k)];
      }
    }
  }
  const Vec3 offset = abs(box.half_edges[0]) + abs(box.half_edges[1]) + abs(box.half_edges[2]) + box.error;
  std::array<std::array<double, most_degree + 1>, 3> power{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    power[axis][0] = 1;
    for (std::size_t m = 1; m <= n; ++m) power[axis][m] = power[axis][m - 1] * offset[static_cast<int>(axis)];
  }
  double radius = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; i + j <= n; ++j) {
      for (std::size_t k = 0; i + j + k <= n; ++k) {
        if (i + j + k > 1) radius += std::fabs(c[index(i, j, k)]) * power[0][i] * power[1][j] * power[2][k];
      }
    }
  }
  if (n > 0) {
    const Vec3 gradient{c[index(1, 0, 0)], c[index(0, 1, 0)], c[index(0, 0, 1)]};
    radius += dot(abs(gradient), box.error);
    for (const Vec3& half_edge : box.half_edges) radius += std::fabs(dot(gradient, half_edge));
  }
  // Each coefficient has taken two roundings for each step along each axis; none of what they were made of exceeds the
  // sum of the terms at the farthest corner.
  const Vec3 farthest = abs(center) + offset;
  const double rounding = gamma(6 * degree_ + 12) * size(farthest) + 2 * evaluate(SizeAt{&farthest, true}).v;
  return {c[0], radius * (1 + gamma(6 * degree_ + 12)) + rounding};
}

}  // namespace tenon
