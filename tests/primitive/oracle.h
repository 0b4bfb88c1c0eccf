#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

#include "support/quad.h"
#include "tenon/primitive/primitive_store.h"

/// What the primitives are, said a second time: one function per face, by the definitions in the scene language's
/// manual. None of the primitives' code is used.
namespace tenon::oracle {

using exact::Vec;

/// Functions that are all <= 0 inside, one per face, in the order of the face numbers.
template <class T>
using Faces = std::vector<T>;

inline double number(const std::vector<FieldValue>& v, std::size_t i) {
  return std::get<double>(v[i]);
}
inline bool flag(const std::vector<FieldValue>& v, std::size_t i) {
  return std::get<bool>(v[i]);
}

template <class T>
void between(Faces<T>& f, T z, T low, T high) {
  f.push_back(low - z);
  f.push_back(z - high);
}
template <class T>
T across(const Vec<T>& p) {
  return p.x * p.x + p.y * p.y;
}

template <class T>
struct Definitions {
  using Values = std::vector<FieldValue>;
  using Definition = void (*)(const Values&, const Vec<T>&, Faces<T>&);

  static void sphere(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T r = number(v, 0);
    f.push_back(dot(p, p) - r * r);
  }
  static void cube(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const Vec3 size = std::get<Vec3>(v[0]);
    const Vec<T> s(size);
    const T shift = flag(v, 1) ? T(0.5) : T(0);
    between(f, p.x + shift * s.x, T(0), s.x);
    between(f, p.y + shift * s.y, T(0), s.y);
    between(f, p.z + shift * s.z, T(0), s.z);
  }
  static void cylinder(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T h = number(v, 0), r = number(v, 1);
    f.push_back(across(p) - r * r);
    between(f, flag(v, 2) ? p.z + h / 2 : p.z, T(0), h);
  }
  static void cone(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T h = number(v, 0), r1 = number(v, 1), r2 = number(v, 2);
    const T z = flag(v, 3) ? p.z + h / 2 : p.z;
    const T radius = (r1 * (h - z) + r2 * z) / h;
    // Beyond the tip the squares alone would make a second cone.
    f.push_back(radius < 0 ? across(p) + radius * radius : across(p) - radius * radius);
    between(f, z, T(0), h);
  }
  static void torus(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T R = number(v, 0), r = number(v, 1);
    const T a = exact::square_root(across(p)) - R;
    f.push_back(a * a + p.z * p.z - r * r);
  }
  static void hyperboloid(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T h = number(v, 0), r = number(v, 1), waist = number(v, 2);
    const T z = 2 * p.z / h;
    f.push_back(across(p) - (waist * waist * (1 - z * z) + r * r * z * z));
    between(f, p.z, -h / 2, h / 2);
  }
  static void paraboloid(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T h = number(v, 0), r = number(v, 1);
    f.push_back(across(p) - r * r * p.z / h);
    between(f, p.z, T(0), h);
  }
  static void halfspace(const Values& v, const Vec<T>& p, Faces<T>& f) {
    f.push_back(dot(Vec<T>(std::get<Vec3>(v[0])), p) - T(number(v, 1)));
  }
  static void convex_polyhedron(const Values& v, const Vec<T>& p, Faces<T>& f) {
    for (const Plane& plane : std::get<std::vector<Plane>>(v[0]))
      f.push_back(dot(Vec<T>(plane.normal), p) - T(plane.d));
  }

  static void within(Faces<T>& f, const Vec<T>& p, const Box3& box) {
    between(f, p.x, T(box.lower.x), T(box.upper.x));
    between(f, p.y, T(box.lower.y), T(box.upper.y));
    between(f, p.z, T(box.lower.z), T(box.upper.z));
  }
  static void quadric(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const auto& q = std::get<QuadricCoefficients>(v[0]);
    f.push_back(q[0] * p.x * p.x + q[1] * p.y * p.y + q[2] * p.z * p.z + q[3] * p.x * p.y + q[4] * p.x * p.z +
                q[5] * p.y * p.z + q[6] * p.x + q[7] * p.y + q[8] * p.z + q[9]);
    const Box3& box = std::get<Box3>(v[1]);
    if (box.is_bounded()) within(f, p, box);
  }
  static void truncated_cone(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T h = number(v, 0), z = p.z / h;
    const T a = number(v, 1) + z * (T(number(v, 3)) - number(v, 1));
    const T b = number(v, 2) + z * (T(number(v, 4)) - number(v, 2));
    f.push_back(p.x * p.x * b * b + p.y * p.y * a * a - a * a * b * b);
    const T x = std::max(number(v, 1), number(v, 3)), y = std::max(number(v, 2), number(v, 4));
    between(f, p.x, -x, x);
    between(f, p.y, -y, y);
    between(f, p.z, T(0), h);
  }
  static std::array<T, 13> powers(T x) {
    std::array<T, 13> all{1};
    for (std::size_t n = 1; n < all.size(); ++n) all[n] = all[n - 1] * x;
    return all;
  }
  static void algebraic(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const std::array<T, 13> x = powers(p.x), y = powers(p.y), z = powers(p.z);
    T sum = 0;
    for (const PolynomialTerm& t : std::get<PolynomialTerms>(v[0])) {
      sum +=
          t.a * x[static_cast<std::size_t>(t.i)] * y[static_cast<std::size_t>(t.j)] * z[static_cast<std::size_t>(t.k)];
    }
    f.push_back(sum);
    within(f, p, std::get<Box3>(v[1]));
  }

  // q of an edge of an outline: zero on its line or circle, growing to the right.
  static T edge_value(const OutlineCorner& a, const OutlineCorner& b, T x, T y) {
    const T wx = T(b.x) - a.x, wy = T(b.y) - a.y, px = x - a.x, py = y - a.y, bulge = a.bulge;
    return bulge * (px * (px - wx) + py * (py - wy)) - (1 - bulge * bulge) / 2 * (wx * py - wy * px);
  }
  // For every edge two faces: the outline on its left, and on its right.
  static void outline_faces(const Outline& outline, T x, T y, T factor, Faces<T>& f) {
    for (const auto& loop : outline.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const T q = factor * edge_value(loop[i], loop[(i + 1) % loop.size()], x, y);
        f.push_back(q);
        f.push_back(-q);
      }
    }
  }
  // By the even-odd rule: how often the way along +x meets the loops. Arcs are met by way of their centres.
  static bool outline_contains(const Outline& outline, T x, T y) {
    bool inside = false;
    for (const auto& loop : outline.loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
        const T wx = T(b.x) - a.x, wy = T(b.y) - a.y;
        if (a.bulge == 0) {
          if ((T(a.y) <= y) != (T(b.y) <= y)) inside ^= x < a.x + (y - a.y) * wx / wy;
          continue;
        }
        const T bulge = a.bulge, k = (1 - bulge * bulge) / (4 * bulge);
        const T cx = (T(a.x) + b.x) / 2 - k * wy, cy = (T(a.y) + b.y) / 2 + k * wx;
        const T square = (wx * wx + wy * wy) * (1 + bulge * bulge) * (1 + bulge * bulge) / (16 * bulge * bulge);
        const T left = square - (y - cy) * (y - cy);
        if (!(left > 0)) continue;
        for (const int sign : {-1, 1}) {
          const T at = cx + sign * exact::square_root(left);
          const T side = wx * (y - a.y) - wy * (at - a.x);
          inside ^= (a.bulge > 0 ? side <= 0 : side > 0) && x < at;
        }
      }
    }
    return inside;
  }
  static T prism_scale(const Values& v, T z) {
    const T h = number(v, 1), low = flag(v, 2) ? -h / 2 : T(0);
    return 1 + (T(number(v, 3)) - 1) * (z - low) / h;
  }
  static void prism(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T h = number(v, 1), s = prism_scale(v, p.z);
    between(f, flag(v, 2) ? p.z + h / 2 : p.z, T(0), h);
    if (s != 0) outline_faces(std::get<Outline>(v[0]), p.x / s, p.y / s, s, f);
  }
  static bool is_in_prism(const Values& v, const Vec<T>& p) {
    const T h = number(v, 1), z = flag(v, 2) ? p.z + h / 2 : p.z, s = prism_scale(v, p.z);
    return z >= 0 && z <= h && s > 0 && outline_contains(std::get<Outline>(v[0]), p.x / s, p.y / s);
  }

  // Where the outline that is swept, turned and scaled has a point; false where it has shrunk to nothing.
  static bool untwisted(const Values& v, const Vec<T>& p, T& x, T& y, T& sx, T& sy) {
    const T h = number(v, 1), share = (flag(v, 2) ? p.z + h / 2 : p.z) / h;
    sx = 1 + (T(number(v, 4)) - 1) * share;
    sy = 1 + (T(number(v, 5)) - 1) * share;
    if (!(sx > 0 && sy > 0)) return false;
    const T angle = T(number(v, 3)) * share, s = exact::sine(angle), c = exact::cosine(angle);
    x = c * p.x / sx - s * p.y / sy;
    y = s * p.x / sx + c * p.y / sy;
    return true;
  }
  static void twisted_prism(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const T h = number(v, 1);
    between(f, flag(v, 2) ? p.z + h / 2 : p.z, T(0), h);
    T x, y, sx, sy;
    if (untwisted(v, p, x, y, sx, sy)) outline_faces(std::get<Outline>(v[0]), x, y, sx * sy, f);
  }
  static bool is_in_twisted_prism(const Values& v, const Vec<T>& p) {
    const T h = number(v, 1), z = flag(v, 2) ? p.z + h / 2 : p.z;
    T x, y, sx, sy;
    return z >= 0 && z <= h && untwisted(v, p, x, y, sx, sy) && outline_contains(std::get<Outline>(v[0]), x, y);
  }

  static void revolution(const Values& v, const Vec<T>& p, Faces<T>& f) {
    outline_faces(std::get<Outline>(v[0]), exact::square_root(across(p)), p.z, T(1), f);
  }
  static bool is_in_revolution(const Values& v, const Vec<T>& p) {
    return outline_contains(std::get<Outline>(v[0]), exact::square_root(across(p)), p.z);
  }

  // The planes of the triangles, outward; which of them matter where is for mesh_contains() to say.
  static void mesh(const Values& v, const Vec<T>& p, Faces<T>& f) {
    const TriangleMesh& m = *std::get<SharedMesh>(v[0]);
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const auto [a, b, c] = m.corners(i);
      const Vec<T> n = normal_of(Vec<T>(a), Vec<T>(b), Vec<T>(c));
      f.push_back(dot(n, p - Vec<T>(a)));
    }
  }
  static Vec<T> normal_of(const Vec<T>& a, const Vec<T>& b, const Vec<T>& c) { return cross(b - a, c - a); }
  static Vec<T> cross(const Vec<T>& a, const Vec<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  // How often the mesh winds around a point: what a half-line from it, in a direction that no scene has, crosses.
  static bool mesh_contains(const Values& v, const Vec<T>& p) {
    const TriangleMesh& m = *std::get<SharedMesh>(v[0]);
    const Vec<T> d{T(0.5377261930183), T(-0.2641873309437), T(0.8006420971529)};
    int winding = 0;
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const auto [a_, b_, c_] = m.corners(i);
      const Vec<T> a = Vec<T>(a_) - p, b = Vec<T>(b_) - p, c = Vec<T>(c_) - p;
      const T u = dot(d, cross(b, c)), w = dot(d, cross(c, a)), q = dot(d, cross(a, b));
      const bool all_positive = u > 0 && w > 0 && q > 0, all_negative = u < 0 && w < 0 && q < 0;
      if (!all_positive && !all_negative) continue;
      const Vec<T> n = normal_of(a, b, c);
      const T t = dot(n, a) / dot(n, d);
      if (t > 0) winding += all_positive ? 1 : -1;
    }
    return winding > 0;
  }

  /// Whether a point is inside, for kinds whose faces do not all bound it everywhere; null for the others.
  using Membership = bool (*)(const Values&, const Vec<T>&);
  static Membership find_membership(std::string_view kind) {
    return kind == "prism"           ? is_in_prism
           : kind == "twisted_prism" ? is_in_twisted_prism
           : kind == "revolution"    ? is_in_revolution
           : kind == "mesh"          ? mesh_contains
                                     : nullptr;
  }

  static Definition find(std::string_view kind) {
    static const std::map<std::string_view, Definition> all{
        {"sphere", sphere},
        {"cube", cube},
        {"cylinder", cylinder},
        {"cone", cone},
        {"torus", torus},
        {"hyperboloid", hyperboloid},
        {"paraboloid", paraboloid},
        {"halfspace", halfspace},
        {"convex_polyhedron", convex_polyhedron},
        {"prism", prism},
        {"revolution", revolution},
        {"twisted_prism", twisted_prism},
        {"mesh", mesh},
        {"quadric", quadric},
        {"truncated_cone", truncated_cone},
        {"algebraic", algebraic},
    };
    const auto found = all.find(kind);
    return found == all.end() ? nullptr : found->second;
  }
};

/// One solid, by its definition.
template <class T>
class Solid {
 public:
  Solid(std::string_view kind, std::vector<FieldValue> values)
      : define_(Definitions<T>::find(kind)),
        is_inside_(Definitions<T>::find_membership(kind)),
        values_(std::move(values)) {}

  bool is_defined() const { return define_ != nullptr; }
  /// All face functions at a point.
  const Faces<T>& faces(const Vec<T>& p) const {
    faces_.clear();
    define_(values_, p, faces_);
    return faces_;
  }
  bool contains(const Vec<T>& p) const {
    if (is_inside_ != nullptr) return is_inside_(values_, p);
    for (const T& f : faces(p)) {
      if (f > 0) return false;
    }
    return true;
  }
  /// The gradient of one face's function, by central differences over a distance that squares to the last bits.
  Vec<T> gradient(const Vec<T>& p, std::size_t face, T step) const {
    const auto slope = [&](const Vec<T>& e) {
      const T high = faces(p + step * e)[face];
      return (high - faces(p - step * e)[face]) / (2 * step);
    };
    return {slope({1, 0, 0}), slope({0, 1, 0}), slope({0, 0, 1})};
  }

 private:
  typename Definitions<T>::Definition define_;
  typename Definitions<T>::Membership is_inside_;
  std::vector<FieldValue> values_;
  mutable Faces<T> faces_;
};

}  // namespace tenon::oracle
