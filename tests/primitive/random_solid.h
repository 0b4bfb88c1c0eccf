#pragma once

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "primitive/dispatch.h"
#include "primitive/oracle.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/random_outline.h"
#include "support/random_polynomials.h"

namespace tenon {

/// The kinds, for tests that every primitive signs by being in the list.
class EveryKind : public testing::TestWithParam<const PrimitiveKind*> {
 public:
  static auto all() {
    std::vector<const PrimitiveKind*> kinds;
    for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
      // A surface has no inside; tests of its own ask what it promises.
      if (!kind.surface) kinds.push_back(&kind);
    }
    return testing::ValuesIn(kinds);
  }
  static std::string label(const testing::TestParamInfo<const PrimitiveKind*>& info) {
    return std::string(info.param->name);
  }
  const PrimitiveKind& kind() const { return *GetParam(); }
  /// A seed of the kind's own.
  std::uint64_t seed() const {
    std::uint64_t h = 1469598103934665603u;
    for (const char c : kind().name) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return h;
  }
};

/// Values for one field, by its unit and type alone.
class RandomValues {
 public:
  explicit RandomValues(Random& random) : random_(random), scale_(random.magnitude(-2, 2)) {}

  std::vector<FieldValue> draw(const PrimitiveKind& kind) {
    std::vector<FieldValue> values;
    for (const FieldInfo& field : kind.fields) {
      unit_ = field.unit;
      if (field.name == "hull") {
        values.emplace_back(false);
        continue;
      }
      if (field.name == "twist") {
        values.emplace_back(random_.chance(0.2) ? 0.0 : random_.chance(0.2) ? 90.0 : random_.uniform(-400, 400));
        continue;
      }
      values.push_back(std::visit([this](const auto& fallback) { return FieldValue(like(fallback)); }, field.fallback));
    }
    return values;
  }

 private:
  double like(double) {
    if (unit_ == Unit::none) return random_.chance(0.5) ? 1 : random_.chance(0.1) ? 0 : random_.uniform(0, 2);
    return length() * (random_.chance(0.05) ? -1 : 1) * (random_.chance(0.05) ? 0 : 1);
  }
  bool like(bool) { return random_.chance(0.5); }
  Vec3 like(const Vec3&) {
    if (unit_ == Unit::length) return {length(), length(), length()};
    return random_.chance(0.2) ? Vec3{0, 0, random_.sign()} : random_.magnitude(-3, 3) * random_.direction();
  }
  // A box with some corners cut off.
  std::vector<Plane> like(const std::vector<Plane>&) {
    std::vector<Plane> planes;
    const Vec3 middle = length() * random_.in_cube();
    const auto add = [&](const Vec3& n, double depth) {
      planes.push_back({n, dot(n, middle) + depth * tenon::length(n)});
    };
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 n;
      n[axis] = random_.magnitude(-1, 1);
      add(n, length());
      add(-n, length());
    }
    for (int i = random_.below(6); i > 0; --i) add(random_.magnitude(-1, 1) * random_.direction(), length());
    return planes;
  }
  Outline like(const Outline&) { return RandomOutline(random_, length()).draw(); }
  // A bumpy ball, a ring or a box, stretched and somewhere.
  SharedMesh like(const SharedMesh&) {
    const Vec3 offset = random_.chance(0.5) ? Vec3{} : length() * random_.in_cube();
    TriangleMesh mesh;
    switch (random_.below(3)) {
      case 0:
        mesh = meshes::star(random_.below(3), [&](const Vec3&) { return random_.uniform(0.4, 1); });
        break;
      case 1:
        mesh = meshes::ring(1, 0.4, 3 + random_.below(5), 3 + random_.below(4));
        break;
      default:
        mesh = meshes::box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    }
    mesh = meshes::scaled(std::move(mesh), {length(), length(), length()}, offset);
    mesh.local = random_.chance(0.3) ? MeshStructure::kd : MeshStructure::bvh;
    return meshes::share(std::move(mesh));
  }
  Choice like(const Choice& fallback) {
    return {static_cast<std::uint8_t>(random_.below(static_cast<int>(fallback.names.size()))), fallback.names};
  }
  Box3 like(const Box3& fallback) {
    if (!fallback.is_bounded() && random_.chance(0.4)) return fallback;
    return random_polynomials_.box();
  }
  QuadricCoefficients like(const QuadricCoefficients&) { return random_polynomials_.quadric(); }
  PolynomialTerms like(const PolynomialTerms&) { return random_polynomials_.terms(); }
  // Fields of surfaces.
  template <class T>
  T like(const T& fallback) {
    return fallback;
  }
  double length() { return random_.chance(0.1) ? random_.magnitude(-3, 3) : scale_ * random_.magnitude(-0.7, 0.7); }

  Random& random_;
  double scale_;
  RandomPolynomials random_polynomials_{random_, scale_};
  Unit unit_ = Unit::none;
};

/// A primitive of a kind with random fields, in a store of its own.
struct RandomSolid {
  PrimitiveStore store;
  PrimitiveId id;
  std::vector<FieldValue> values;
  Box3 bounds;      ///< for unbounded ones a cube around the origin
  double size = 0;  ///< the largest extent of the bounds

  RandomSolid(const PrimitiveKind& kind, Random& random) {
    do {
      draw(kind, random);
    } while (may_be_empty(kind) && !is_ever_hit(random));
  }

  /// Somewhere in the bounds, grown by a fifth.
  Vec3 point(Random& random) const { return bounds.center() + 0.6 * bounds.size() * random.in_cube(); }

  /// A ray that has a chance to meet the solid: from anywhere near towards anywhere near, sometimes along axes, with
  /// directions of any length.
  LocalRay ray(Random& random) const {
    const Vec3 through = point(random);
    Vec3 d = random.direction();
    if (random.chance(0.25)) {
      for (int axis = 0; axis < 3; ++axis) {
        if (random.chance(0.5)) d[axis] = random.chance(0.5) ? 0 : d[axis] * random.magnitude(-18, 0);
      }
      if (d == Vec3{}) d.z = 1;
    }
    const double back = random.chance(0.3) ? 0 : random.uniform(0, 3) * size;
    LocalRay ray;
    ray.origin = through - back * d;
    ray.direction = random.magnitude(-3, 3) * d;
    return ray;
  }

  /// A ray that grazes the solid: through a point of its surface, along the surface but for a tilt of any magnitude.
  LocalRay grazing_ray(Random& random) const {
    for (;;) {
      const LocalRay first = ray(random);
      Spans out;
      spans(store, id, first, out);
      if (out.empty()) continue;
      const Crossing& c = out[static_cast<std::size_t>(random.below(static_cast<int>(out.size())))];
      if (!std::isfinite(c.t)) continue;
      const Vec3 p = first.origin + c.t * first.direction;
      const Vec3 n = normalize(normal(store, id, p, c.face));
      const Vec3 along = normalize(cross(n, random.direction()));
      LocalRay grazing;
      grazing.direction = along + random.sign() * random.magnitude(-17, -1) * n;
      const double offset = random.sign() * random.magnitude(-17, -1) * size;
      grazing.origin = p + (random.chance(0.5) ? offset : 0.0) * n - random.uniform(-2, 2) * size * grazing.direction;
      return grazing;
    }
  }

 private:
  void draw(const PrimitiveKind& kind, Random& random) {
    for (;;) {
      values = RandomValues(random).draw(kind);
      const Result<PrimitiveId> added = store.add(kind, values);
      if (!added) continue;
      id = *added;
      break;
    }
    bounds = local_bounds(store, id);
    if (!bounds.is_bounded()) {
      const auto* normal = std::get_if<Vec3>(&values[0]);
      const double d = normal != nullptr ? std::fabs(std::get<double>(values[1])) / length(*normal) + 1
                                         : RandomPolynomials::size_of(std::get<QuadricCoefficients>(values[0]));
      bounds = {{-2 * d, -2 * d, -2 * d}, {2 * d, 2 * d, 2 * d}};
    }
    size = max_component(bounds.size());
  }

  // A polynomial may be positive all over the box.
  static bool may_be_empty(const PrimitiveKind& kind) {
    return std::any_of(kind.fields.begin(), kind.fields.end(),
                       [](const FieldInfo& f) { return std::holds_alternative<Box3>(f.fallback); });
  }
  bool is_ever_hit(Random& random) const {
    Spans out;
    for (int i = 0; i < 40 && out.empty(); ++i) {
      spans(store, id, ray(random), out);
      std::erase_if(out, [](const Crossing& c) { return !std::isfinite(c.t); });
    }
    return !out.empty();
  }
};

}  // namespace tenon
