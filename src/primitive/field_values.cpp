#include "primitive/field_values.h"

#include <algorithm>
#include <type_traits>

#include "tenon/base/hash_index.h"

namespace tenon {

namespace {

// Everything a field may be, down to its numbers.
void add_to(ContentHash& hash, double number) {
  hash.add(number);
}
void add_to(ContentHash& hash, bool flag) {
  hash.add(flag);
}
void add_to(ContentHash& hash, const Vec3& v) {
  for (int i = 0; i < 3; ++i) hash.add(v[i]);
}
void add_to(ContentHash& hash, const Plane& plane) {
  add_to(hash, plane.normal);
  hash.add(plane.d);
}
void add_to(ContentHash& hash, const OutlineCorner& corner) {
  for (const double number : {corner.x, corner.y, corner.bulge}) hash.add(number);
}
void add_to(ContentHash& hash, const PolynomialTerm& term) {
  for (const int exponent : {term.i, term.j, term.k}) hash.add(exponent);
  hash.add(term.a);
}
void add_to(ContentHash& hash, const Box3& box) {
  add_to(hash, box.lower);
  add_to(hash, box.upper);
}
void add_to(ContentHash& hash, const Choice& choice) {
  hash.add_text(choice.name());
}
// A few vertices tell meshes apart; a large one may be imported a million times.
void add_to(ContentHash& hash, const SharedMesh& mesh) {
  if (!mesh) return;
  const std::size_t count = mesh->vertices.size();
  hash.add(count);
  hash.add(mesh->triangles.size());
  const std::size_t step = std::max<std::size_t>(1, count / 16);
  for (std::size_t i = 0; i < count; i += step) add_to(hash, mesh->vertices[i]);
}
template <class Range>
requires requires(const Range& range) {
  range.begin();
}
void add_to(ContentHash& hash, const Range& range) {
  hash.add(range.size());
  for (const auto& item : range) add_to(hash, item);
}
void add_to(ContentHash& hash, const Outline& outline) {
  add_to(hash, outline.loops);
}

bool same_mesh(const SharedMesh& a, const SharedMesh& b) {
  if (a == b || !a || !b) return a == b;
  return a->vertices == b->vertices && a->triangles == b->triangles && a->normals == b->normals &&
         a->corner_normals == b->corner_normals && a->local == b->local && a->source == b->source;
}

bool are_same(const FieldValue& a, const FieldValue& b) {
  const auto* mesh = std::get_if<SharedMesh>(&a);
  const auto* other = std::get_if<SharedMesh>(&b);
  return mesh != nullptr && other != nullptr ? same_mesh(*mesh, *other) : a == b;
}

}  // namespace

std::uint64_t hash_of(std::span<const FieldValue> values) {
  ContentHash hash;
  for (const FieldValue& value : values) {
    hash.add(value.index());
    std::visit([&](const auto& content) { add_to(hash, content); }, value);
  }
  return hash.value();
}

bool are_equal(std::span<const FieldValue> a, std::span<const FieldValue> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), are_same);
}

}  // namespace tenon
