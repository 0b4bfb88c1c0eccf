#pragma once

#include <cmath>
#include <numbers>

#include "tenon/math/affine3.h"
#include "tenon/math/vec3.h"

/// Arithmetic with 113 bits, for tests that judge what double computes. Nothing here is shared with what is judged.
namespace tenon::exact {

__extension__ typedef __float128 Quad;

inline Quad absolute(Quad a) {
  return a < 0 ? -a : a;
}

/// Newton's method from the double's root: 53, 106, 113 bits.
inline Quad square_root(Quad a) {
  if (!(a > 0)) return 0;
  Quad x = std::sqrt(static_cast<double>(a));
  if (!(x > 0)) return 0;
  for (int i = 0; i < 3; ++i) x = (x + a / x) / 2;
  return x;
}
inline long double square_root(long double a) {
  return a > 0 ? std::sqrt(a) : 0;
}

template <class T>
struct Vec {
  T x = 0, y = 0, z = 0;

  Vec() = default;
  Vec(T a, T b, T c) : x(a), y(b), z(c) {}
  explicit Vec(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

  friend Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec operator*(const T& s, const Vec& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend T dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

  Vec3 rounded() const { return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)}; }
};

/// A line.
template <class T>
struct Line {
  Vec<T> origin, direction;

  Vec<T> at(T t) const { return origin + t * direction; }
};

/// Sine of an angle in degrees: quarter turns are taken out exactly, the rest is Taylor's series.
inline Quad sine(Quad degrees) {
  while (degrees > 180) degrees -= 360;
  while (degrees <= -180) degrees += 360;
  if (degrees > 90) degrees = 180 - degrees;
  if (degrees < -90) degrees = -180 - degrees;
  // pi as the sum of two doubles and a rest.
  const Quad pi = Quad{0x1.921fb54442d18p+1} + Quad{0x1.1a62633145c07p-53} + Quad{-0x1.f1976b7ed8fbcp-109};
  const Quad x = degrees * pi / 180;
  Quad term = x, sum = x;
  for (int k = 1; k < 24; ++k) {
    term *= -x * x / ((2 * k) * (2 * k + 1));
    sum += term;
  }
  return sum;
}
inline Quad cosine(Quad degrees) {
  return sine(90 - degrees);
}

inline long double sine(long double degrees) {
  return std::sin(std::remainder(degrees, 360.0L) * (std::numbers::pi_v<long double> / 180));
}
inline long double cosine(long double degrees) {
  return std::cos(std::remainder(degrees, 360.0L) * (std::numbers::pi_v<long double> / 180));
}

/// An affine map p -> L p + b.
struct Map {
  Quad m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

  Map() = default;
  explicit Map(const Affine3& a) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) m[i][j] = a.m[i][j];
    }
  }
  /// OpenSCAD's rotate([x, y, z]): Rz Ry Rx.
  static Map rotate(const Vec3& degrees) { return around(2, degrees.z) * around(1, degrees.y) * around(0, degrees.x); }
  static Map around(int axis, double degrees) {
    Map r;
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    r.m[i][i] = r.m[j][j] = cosine(Quad{degrees});
    r.m[j][i] = sine(Quad{degrees});
    r.m[i][j] = -r.m[j][i];
    return r;
  }

  Vec<Quad> direction(const Vec<Quad>& v) const {
    return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
            m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
  }
  Vec<Quad> point(const Vec<Quad>& v) const { return direction(v) + Vec<Quad>{m[0][3], m[1][3], m[2][3]}; }

  friend Map operator*(const Map& a, const Map& b) {
    Map c;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) {
        c.m[i][j] = j == 3 ? a.m[i][3] : 0;
        for (int k = 0; k < 3; ++k) c.m[i][j] += a.m[i][k] * b.m[k][j];
      }
    }
    return c;
  }

  Map inverse() const {
    Map r;
    const auto minor = [this](int i, int j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      return m[a][c] * m[b][d] - m[a][d] * m[b][c];
    };
    const Quad det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) r.m[i][j] = minor(j, i) / det;
    }
    const Vec<Quad> b = r.direction({m[0][3], m[1][3], m[2][3]});
    r.m[0][3] = -b.x;
    r.m[1][3] = -b.y;
    r.m[2][3] = -b.z;
    return r;
  }
};

}  // namespace tenon::exact
