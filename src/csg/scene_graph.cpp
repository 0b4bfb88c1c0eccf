#include "tenon/csg/scene_graph.h"

#include <bit>
#include <utility>

namespace tenon {

namespace {

void add_to(ContentHash& hash, const SetOperation& operation) {
  hash.add(operation);
}
void add_to(ContentHash& hash, const Transform& transform) {
  for (const auto& row : transform.parent_from_child.m) {
    for (const double entry : row) hash.add(entry);
  }
}
void add_to(ContentHash& hash, const ColorAttribute& attribute) {
  const Rgba& c = attribute.color;
  for (const double component : {c.r, c.g, c.b, c.a}) hash.add(component);
}
void add_to(ContentHash& hash, const MaterialAttribute& attribute) {
  hash.add(attribute.material.get());
}
void add_to(ContentHash& hash, const CutFacesAttribute& attribute) {
  hash.add(attribute.show);
}
void add_to(ContentHash& hash, const PrimitiveLeaf& leaf) {
  hash.add(leaf.primitive.get());
}

std::uint64_t hash_of(const SceneNode& node) {
  ContentHash hash;
  hash.add(node.content.index());
  std::visit([&](const auto& content) { add_to(hash, content); }, node.content);
  for (const SceneNodeId child : node.children) hash.add(child.get());
  return hash.value();
}

// Bit for bit: 0 and -0 are two places.
bool same(const Affine3& a, const Affine3& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (std::bit_cast<std::uint64_t>(a.m[i][j]) != std::bit_cast<std::uint64_t>(b.m[i][j])) return false;
    }
  }
  return true;
}
bool same(const SetOperation& a, const SetOperation& b) {
  return a == b;
}
bool same(const Transform& a, const Transform& b) {
  return same(a.parent_from_child, b.parent_from_child);
}
bool same(const ColorAttribute& a, const ColorAttribute& b) {
  return a.color == b.color;
}
bool same(const MaterialAttribute& a, const MaterialAttribute& b) {
  return a.material == b.material;
}
bool same(const CutFacesAttribute& a, const CutFacesAttribute& b) {
  return a.show == b.show;
}
bool same(const PrimitiveLeaf& a, const PrimitiveLeaf& b) {
  return a.primitive == b.primitive;
}

bool same(const SceneNode& a, const SceneNode& b) {
  if (a.content.index() != b.content.index() || a.children != b.children) return false;
  return std::visit([&]<class T>(const T& content) { return same(content, std::get<T>(b.content)); }, a.content);
}

}  // namespace

SceneNodeId SceneGraph::add(SceneNode node) {
  const std::uint64_t hash = hash_of(node);
  if (const auto known = index_.find(hash, [&](std::uint32_t i) { return same(nodes[i], node); })) {
    return SceneNodeId{*known};
  }
  node.children.shrink_to_fit();
  index_.note(hash, static_cast<std::uint32_t>(nodes.size()));
  nodes.push_back(std::move(node));
  return SceneNodeId{nodes.size() - 1};
}

}  // namespace tenon
