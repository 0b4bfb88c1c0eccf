#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/random.h"
#include "tenon/math/box3.h"
#include "tenon/primitive/polynomial_terms.h"

namespace tenon {

/// Polynomials in x, y and z whose zeros lie around the origin, at distances of about a given size, and boxes to clip
/// them with.
class RandomPolynomials {
 public:
  RandomPolynomials(Random& random, double size) : random_(random), size_(size) {}

  Box3 box() {
    Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = -size_ * random_.uniform(0.2, 2);
      box.upper[axis] = size_ * random_.uniform(0.2, 2);
    }
    return box;
  }

  /// Of every kind there is: ellipsoids, hyperboloids, cones, cylinders, paraboloids, pairs of planes.
  QuadricCoefficients quadric() {
    QuadricCoefficients q{};
    const auto coefficient = [this] { return random_.chance(0.2) ? 0 : random_.uniform(-1, 1); };
    if (random_.chance(0.2)) {
      // A pair of planes, or one taken twice.
      const double a = coefficient(), b = coefficient(), c = 1, d = random_.uniform(-1, 1);
      const bool twice = random_.chance(0.2);
      const double e = twice ? a : coefficient(), f = twice ? b : coefficient(), g = 1, h = twice ? d : coefficient();
      q = {a * e,         b * f,         c * g,         a * f + b * e, a * g + c * e,
           b * g + c * f, a * h + d * e, b * h + d * f, c * h + d * g, d * h};
    } else {
      for (double& c : q) c = coefficient();
      if (random_.chance(0.5)) {
        for (std::size_t i = 0; i < 3; ++i) q[i] = random_.uniform(0.1, 1);
        q[9] = -random_.uniform(0.1, 1);
      }
      if (random_.chance(0.2)) q[6] = q[7] = q[8] = q[9] = 0;
    }
    for (std::size_t i = 6; i < 9; ++i) q[i] *= size_;
    q[9] *= size_ * size_;
    return q;
  }
  /// How far its features are from the origin, about.
  static double size_of(const QuadricCoefficients& q) {
    double square = 0, linear = 0;
    for (std::size_t i = 0; i < 6; ++i) square = std::fmax(square, std::fabs(q[i]));
    for (std::size_t i = 6; i < 9; ++i) linear = std::fmax(linear, std::fabs(q[i]));
    const double size = std::fmax(linear / square, std::sqrt(std::fabs(q[9]) / square));
    return size > 0 && std::isfinite(size) ? size : 1;
  }

  /// Of degree 1 to 8: a few random terms, or a product of spheres and planes that cross or touch one another.
  PolynomialTerms terms() {
    PolynomialTerms all{{0, 0, 0, random_.sign()}};
    const int degree = 1 + random_.below(random_.chance(0.2) ? 8 : 4);
    if (random_.chance(0.4)) {
      all[0].a *= random_.uniform(0, 1);
      for (int n = 3 + random_.below(10); n > 0; --n) {
        PolynomialTerm t{0, 0, 0, random_.uniform(-1, 1)};
        for (int k = 1 + random_.below(degree); k > 0; --k)
          ++(random_.below(3) == 0 ? t.i : random_.chance(0.5) ? t.j : t.k);
        all.push_back(t);
      }
    } else {
      for (int left = degree; left > 0;) {
        const bool sphere = left > 1 && random_.chance(0.7);
        all = times(all, sphere ? a_sphere() : a_plane());
        left -= sphere ? 2 : 1;
      }
    }
    for (PolynomialTerm& t : all) t.a /= std::pow(size_, t.i + t.j + t.k);
    return all;
  }

 private:
  static PolynomialTerms times(const PolynomialTerms& p, const PolynomialTerms& q) {
    PolynomialTerms product;
    for (const PolynomialTerm& a : p) {
      for (const PolynomialTerm& b : q) {
        const PolynomialTerm t{a.i + b.i, a.j + b.j, a.k + b.k, a.a * b.a};
        const auto like = std::find_if(product.begin(), product.end(), [&t](const PolynomialTerm& other) {
          return other.i == t.i && other.j == t.j && other.k == t.k;
        });
        if (like != product.end()) {
          like->a += t.a;
        } else if (t.a != 0) {
          product.push_back(t);
        }
      }
    }
    return product;
  }
  // Radius and centre on a grid, so that some of them touch.
  PolynomialTerms a_sphere() {
    const double x = 0.25 * random_.below(5) - 0.5, y = 0.25 * random_.below(5) - 0.5,
                 z = 0.25 * random_.below(3) - 0.25;
    const double r = 0.25 * (1 + random_.below(4));
    return {{2, 0, 0, 1},
            {0, 2, 0, 1},
            {0, 0, 2, 1},
            {1, 0, 0, -2 * x},
            {0, 1, 0, -2 * y},
            {0, 0, 1, -2 * z},
            {0, 0, 0, x * x + y * y + z * z - r * r}};
  }
  PolynomialTerms a_plane() {
    return {{1, 0, 0, random_.uniform(-1, 1)},
            {0, 1, 0, random_.uniform(-1, 1)},
            {0, 0, 1, 1},
            {0, 0, 0, random_.uniform(-0.5, 0.5)}};
  }

  Random& random_;
  double size_;
};

}  // namespace tenon
