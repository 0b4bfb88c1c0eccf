#pragma once

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
      : define_(Definitions<T>::find(kind)), values_(std::move(values)) {}

  bool is_defined() const { return define_ != nullptr; }
  /// All face functions at a point.
  const Faces<T>& faces(const Vec<T>& p) const {
    faces_.clear();
    define_(values_, p, faces_);
    return faces_;
  }
  bool contains(const Vec<T>& p) const {
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
  std::vector<FieldValue> values_;
  mutable Faces<T> faces_;
};

}  // namespace tenon::oracle
