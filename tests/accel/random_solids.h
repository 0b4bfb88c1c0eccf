#pragma once

#include <random>
#include <vector>

#include "support/meshes.h"
#include "support/random_outline.h"
#include "support/random_polynomials.h"
#include "support/scene_builder.h"

namespace tenon::fixtures {

/// Draws that are the same on every machine; the standard's distributions are not.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
  bool one_in(int n) { return below(n) == 0; }
  /// In [low, high).
  double real(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
  Vec3 vector(double low, double high) { return {real(low, high), real(low, high), real(low, high)}; }
  Vec3 in_box(const Box3& box) {
    return {real(box.lower.x, box.upper.x), real(box.lower.y, box.upper.y), real(box.lower.z, box.upper.z)};
  }
  /// Length 1, any direction.
  Vec3 direction() {
    for (;;) {
      const Vec3 v = vector(-1, 1);
      if (dot(v, v) <= 1 && dot(v, v) > 0.01) return normalize(v);
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// A value that some primitive may take for the field; add() refuses what is none.
inline FieldValue random_value(Draw& draw, const FieldInfo& field) {
  if (field.name == "hull") return false;  // a solid
  if (std::holds_alternative<SharedMesh>(field.fallback)) {
    if (draw.one_in(3)) return meshes::share(meshes::ring(0.8, 0.35, 3 + draw.below(6), 3 + draw.below(4)));
    return meshes::share(meshes::star(draw.below(3), [&](const Vec3&) { return draw.real(0.6, 1.2); }));
  }
  if (std::holds_alternative<bool>(field.fallback)) return draw.one_in(2);
  if (std::holds_alternative<Vec3>(field.fallback)) return draw.vector(draw.one_in(2) ? -1.0 : 0.3, 1.5);
  if (std::holds_alternative<double>(field.fallback)) return draw.real(0.2, 1.2);
  if (std::holds_alternative<Outline>(field.fallback)) {
    Random random(static_cast<std::uint64_t>(draw.below(1 << 30)));
    return RandomOutline(random, 0.7).draw();
  }
  if (const auto* choice = std::get_if<Choice>(&field.fallback)) {
    return Choice{static_cast<std::uint8_t>(draw.below(static_cast<int>(choice->names.size()))), choice->names};
  }
  Random random(static_cast<std::uint64_t>(draw.below(1 << 30)));
  RandomPolynomials polynomials(random, 1);
  if (std::holds_alternative<Box3>(field.fallback)) return polynomials.box();
  if (std::holds_alternative<QuadricCoefficients>(field.fallback)) return polynomials.quadric();
  if (std::holds_alternative<PolynomialTerms>(field.fallback)) return polynomials.terms();
  // A box with its corners cut, which is bounded whatever the cuts.
  std::vector<Plane> planes{{{1, 0, 0}, 1},  {{-1, 0, 0}, 1}, {{0, 1, 0}, 1},
                            {{0, -1, 0}, 1}, {{0, 0, 1}, 1},  {{0, 0, -1}, 1}};
  for (int i = draw.below(5); i > 0; --i) planes.push_back({draw.direction(), draw.real(0.5, 1.2)});
  return planes;
}

/// A primitive of any kind there is, with sizes around 1; of a half-space what it cuts from a bounded one.
inline SceneNodeId random_primitive(Draw& draw, SceneBuilder& b, bool may_be_unbounded = true) {
  const auto kinds = PrimitiveStore::kinds();
  for (;;) {
    const PrimitiveKind& kind = kinds[static_cast<std::size_t>(draw.below(static_cast<int>(kinds.size())))];
    if (kind.surface || (!kind.bounded && !(may_be_unbounded && draw.one_in(3)))) continue;
    std::vector<FieldValue> values;
    for (const FieldInfo& field : kind.fields) values.push_back(random_value(draw, field));
    const auto id = b.try_primitive(kind, values);
    if (!id) continue;
    if (kind.bounded) return *id;
    const SceneNodeId whole = random_primitive(draw, b, false);
    return draw.one_in(2) ? b.intersect({whole, *id}) : b.subtract({whole, *id});
  }
}

/// Turned, stretched, sheared or mirrored, and moved by up to `spread`.
inline SceneNodeId random_place(Draw& draw, SceneBuilder& b, double spread, SceneNodeId node) {
  if (draw.one_in(3)) node = b.transform(Affine3::scale(draw.vector(0.4, 1.8)), node);
  if (draw.one_in(4)) node = b.transform(Affine3::mirror(draw.direction()), node);
  if (draw.one_in(6)) {
    node = b.transform({{{{1, draw.real(-0.8, 0.8), draw.real(-0.8, 0.8), 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}}, node);
  }
  if (!draw.one_in(4)) node = b.rotate(draw.vector(-180, 180), node);
  return b.translate(draw.vector(-spread, spread), node);
}

/// Operations in random shape over these operands, each used once.
inline SceneNodeId random_subtree(Draw& draw, SceneBuilder& b, std::vector<SceneNodeId> operands) {
  while (operands.size() > 1) {
    std::vector<SceneNodeId> taken;
    for (int arity = 2 + draw.below(3); arity > 0 && !operands.empty(); --arity) {
      const std::size_t i = static_cast<std::size_t>(draw.below(static_cast<int>(operands.size())));
      taken.push_back(operands[i]);
      operands.erase(operands.begin() + static_cast<std::ptrdiff_t>(i));
    }
    const int op = draw.below(6);
    // Complements where they leave something out, or all of space is soon full.
    if (op == 5 && taken.size() > 1 && draw.one_in(2)) taken.back() = b.complement(taken.back());
    operands.push_back(op < 3 ? b.unite(taken) : op < 5 ? b.subtract(taken) : b.intersect(taken));
  }
  return operands.front();
}

/// A union of random trees of a few operands each: in one tree of many, little is left to see.
inline SceneNodeId random_tree(Draw& draw, SceneBuilder& b, const std::vector<SceneNodeId>& operands) {
  std::vector<SceneNodeId> groups;
  for (std::size_t i = 0; i < operands.size();) {
    const std::size_t size = std::min(operands.size() - i, static_cast<std::size_t>(3 + draw.below(8)));
    const auto begin = operands.begin() + static_cast<std::ptrdiff_t>(i);
    groups.push_back(random_subtree(draw, b, {begin, begin + static_cast<std::ptrdiff_t>(size)}));
    i += size;
  }
  return b.unite(groups);
}

}  // namespace tenon::fixtures
